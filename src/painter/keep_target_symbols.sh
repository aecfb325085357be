#!/bin/sh
# keep_target_symbols.sh TARGET OBJECT LD OBJCOPY COMPILE...: runs the compile command, which writes OBJECT, and makes
# local every symbol of OBJECT that does not bear TARGET's name (plumbline_simd() in CMakeLists.txt).
set -eu
target=$1 object=$2 ld=$3 objcopy=$4
shift 4
"$@"
"$ld" -r --force-group-allocation "$object" -o "$object.merged"
"$objcopy" --wildcard "--keep-global-symbol=*$target*" "$object.merged" "$object"
rm "$object.merged"
