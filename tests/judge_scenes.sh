#!/bin/sh
# judge_scenes.sh JSON COMMAND...: plumb check of some scenes. Exit code 1 is left to the scenes' own tests; any other
# fails this one.
json=$1
shift
rm -f "$json"
"$@" --json "$json"
[ $? -le 1 ] && [ -f "$json" ]
