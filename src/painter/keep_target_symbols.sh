#!/bin/sh
# keep_target_symbols.sh TARGET OBJECT LD OBJCOPY COMPILE...: runs the compile command with `-o OBJECT.whole`, and makes
# OBJECT of it, where every symbol that does not bear TARGET's name is local (plumbline_simd() in CMakeLists.txt). A
# killed run leaves no OBJECT.
set -eu
target=$1 object=$2 ld=$3 objcopy=$4
shift 4
before=
for word in "$@"; do
  shift
  [ "$before" != -o ] || word=$object.whole
  set -- "$@" "$word"
  before=$word
done
rm -f "$object"
"$@"
"$ld" -r --force-group-allocation "$object.whole" -o "$object.merged"
"$objcopy" --wildcard "--keep-global-symbol=*$target*" "$object.merged" "$object.local"
mv "$object.local" "$object"
rm "$object.merged" "$object.whole"
