#!/bin/sh
# shared_code.sh NM SOURCE BUILD: functions and constants of the scene, the stages, the dialect and the transforms that
# references and judges use, against the list tests/shared_code.tsv, whose rows say why each may be shared. Functions
# with a symbol of their own by nm, from the static libraries; inline functions and constants by name, from the headers.
set -eu
nm=$1 source=$2 build=$3
export LC_ALL=C
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

names() { sed -E 's/^plumbline:://; s/\(.*//; s/\[abi:[a-z0-9]*\]//g' | sort -u; }

for library in scene scene_json scene_texture scene_mesh scene_file capture capture_files dialect transforms; do
  "$nm" -C -g --defined-only "$build/src/libplumbline_$library.a"
done 2>/dev/null | sed -nE 's/^[0-9a-f]+ [TRDB] (plumbline::.*)$/\1/p' | sort -u >"$work/defined"
for library in "$build"/reference/libplumbline_*.a "$build"/src/libplumbline_check_*.a; do
  "$nm" -C --undefined-only "$library"
done 2>/dev/null | sed -nE 's/^ +U (plumbline::.*)$/\1/p' | sort -u >"$work/used"
comm -12 "$work/defined" "$work/used" | names >"$work/symbols"

cd "$source"
cat src/scene/*.h src/scene/*/*.h src/capture/*.h src/capture/files/*.h src/dialect/*.h src/transforms/*.h |
  sed -nE -e 's/^(inline |constexpr )+[^=(]*[ &*>]([A-Za-z_]+)[ ]?(\(|=|\{).*/\2/p' | sort -u >"$work/inline"
find reference src/check -name "*.cpp" -o -name "*.h" | xargs cat | sed -E 's,//.*,,; s/"([^"\\]|\\.)*"//g' |
  grep -oE '[A-Za-z_]+' | sort -u >"$work/words"
comm -12 "$work/inline" "$work/words" >"$work/headers"

sort -u "$work/symbols" "$work/headers" >"$work/shared"
sed "/^#/d" tests/shared_code.tsv >"$work/rows"
awk -F '\t' 'NF != 2 || $2 == "" { print "tests/shared_code.tsv: a row without a reason: " $1; bad = 1 } END { exit bad }' "$work/rows"
cut -f 1 "$work/rows" | sort >"$work/listed"
test "$(uniq -d "$work/listed" | wc -l)" -eq 0 || { echo "rows twice:"; uniq -d "$work/listed"; exit 1; }
test -s "$work/symbols" && test -s "$work/headers" || { echo "expected shared functions, found none: is nm another?"; exit 1; }
new=$(comm -13 "$work/listed" "$work/shared") gone=$(comm -23 "$work/listed" "$work/shared")
test -z "$new" || printf 'shared, and not in tests/shared_code.tsv (write it a second time, or say why it may be shared):\n%s\n' "$new"
test -z "$gone" || printf 'in tests/shared_code.tsv, and not shared any more:\n%s\n' "$gone"
test -z "$new$gone" || exit 1
