#!/bin/sh
# A scene's test: what plumb check --rows left of it; ends 0 where it holds. No programs are started: there are hundreds
# of such tests.
while IFS= read -r line; do
  printf '%s\n' "$line"
  last=$line
done <"$1"
[ "$last" = holds ]
