#!/bin/sh
# A scene's test: what plumb check --rows left of it; ends 0 where it holds.
cat "$1" && [ "$(tail -n 1 "$1")" = holds ]
