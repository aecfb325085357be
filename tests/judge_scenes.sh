#!/bin/sh
# judge_scenes.sh JSON COMMAND...: plumb check of some scenes. What differs (1) fails its scene's test; that they could be
# judged, to the end, is this one's.
json=$1
shift
rm -f "$json"
"$@" --json "$json"
[ $? -le 1 ] && [ -f "$json" ]
