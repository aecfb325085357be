#!/bin/sh
# Builds and tests the projects beside this file, copied out of the tree, against plumbline as it is installed:
# use_installed.sh PREFIX FOLDER [renderer]. FOLDER is emptied first. The sample passes, and with its planted bug it
# fails and names coverage, with the page's path. The documents' links lead to files. renderer: plumbline was built
# without what judges.
set -eu
[ $# -ge 2 ] || {
  echo "usage: use_installed.sh PREFIX FOLDER [renderer]" >&2
  exit 2
}
case ${3:-renderer} in renderer) ;; *)
  echo "use_installed: expected 'renderer' or nothing, found $3" >&2
  exit 2
  ;;
esac
here=$(cd "$(dirname "$0")" && pwd)
prefix=$(cd "$1" && pwd)
if [ -e "$2" ] && [ ! -d "$2/library" ] && [ -n "$(ls -A "$2" 2>/dev/null || echo a file)" ]; then
  echo "use_installed: $2: expected a new folder, an empty one, or one that this script has made" >&2
  exit 2
fi
rm -rf "$2" && mkdir -p "$2"
folder=$(cd "$2" && pwd)
cp -r "$here/library" "$folder/library"
sample="it's my \$sample \`id\` {serve}" # in every path, and nothing of it is the shell's or plumb's
cp -r "$here/sample" "$folder/$sample"
cd "$folder"
export CTEST_OUTPUT_ON_FAILURE=1 CMAKE_PREFIX_PATH="$prefix"
! command -v ninja >/dev/null || export CMAKE_GENERATOR=Ninja
unset CXXFLAGS LDFLAGS PLUMBLINE_PLUMB || true

fail() {
  echo "use_installed: $*" >&2
  exit 1
}
built() { # PROJECT OPTION...
  project=$1 && shift
  cmake -S "$project" -B "$project/build" "$@" >"$project/log" && cmake --build "$project/build" -j 2 >>"$project/log" || {
    cat "$project/log"
    fail "$project is not built"
  }
}

cd "$prefix/share/doc/plumbline" # every link of the documents
find . -name '*.md' | while read -r document; do
  grep -o '][(][^):#][^):]*)' "$document" | sed 's/^](//; s/)$//; s/#.*//' | while read -r link; do
    [ -e "$(dirname "$document")/$link" ] || echo "$document: $link"
  done
done >"$folder/broken"
[ ! -s "$folder/broken" ] || fail "documents link to files that are not installed: $(cat "$folder/broken")"
cd "$folder"
built library "-DHARNESS=$([ "${3:-}" = renderer ] && echo OFF || echo ON)"
ctest --test-dir library/build || fail "the libraries' tests"
[ "${3:-}" != renderer ] || exit 0
"$prefix/bin/plumb" render "$sample/fan.json" -o fan.png && [ -s fan.png ] || fail "plumb writes no image"
built "$sample"
ctest --test-dir "$sample/build" || fail "the sample's tests"
mkdir own && cp "$sample/build/my_program" own
# The suite, too, and by conventions that plumb finds.
"$prefix/bin/plumb" learn --program "'$PWD/own/my_program' {serve}" -o own.json || fail "the sample's conventions are not learned"
"$prefix/bin/plumb" check "$prefix/share/plumbline/scenes/coverage" "$prefix/share/plumbline/scenes/depth" --program "'$PWD/own/my_program' {serve}" --conventions own.json --from window || fail "the sample is not right"
homework=$prefix/share/plumbline/homework/gl
"$prefix/bin/plumb" check "$homework" --program "'$PWD/own/my_program' {serve}" --conventions own.json --grade "$homework.rubric.json" --grades grades.json || [ $? = 1 ] || fail "the homework is not graded"
[ -s grades.json ] || fail "plumb writes no grades"
built "$sample" -DPLANTED_BUG=ON
ctest --test-dir "$sample/build" >"$sample"/wrong.txt && fail "the planted bug was not found"
for said in "likely stage: coverage" "shows the scene" "page: .*index.html" "3 tests failed out of 3"; do
  grep -q "$said" "$sample"/wrong.txt || {
    cat "$sample"/wrong.txt
    fail "expected '$said' of the planted bug"
  }
done
[ "$(grep -c "page: .*index.html" "$sample"/wrong.txt)" = 3 ] || fail "expected a page of each test"
page=$(sed -n 's/.*page: \(.*index.html\)/\1/p' "$sample"/wrong.txt | head -1)
[ -f "$page" ] || fail "no page $page"
# What cannot be judged passes neither way.
PLUMBLINE_PLUMB=no_such_plumb ctest --test-dir "$sample/build" -R Rasterizer >"$sample"/unjudged.txt && fail "no plumb, and the test passes"
grep -q "not judged: no_such_plumb (PLUMBLINE_PLUMB)" "$sample"/unjudged.txt || fail "expected the name of the plumb that is not there"
PLUMBLINE_PLUMB=true ctest --test-dir "$sample/build" -R Rasterizer >/dev/null && fail "a plumb that judges nothing, and the test passes"
cp -r "$here/refused" refused && mkdir one two
for copy in refused/fan.json 'refused/fan[1].json' one/fan.json two/fan.json; do cp "$sample/fan.json" "$copy"; done
refused() { # WORDS MESSAGE
  cmake -S refused -B refused/build "-DWORDS=$1" >refused/log 2>&1 && fail "taken: plumbline_add_renderer_tests($1)"
  tr -s '\n ' ' ' <refused/log | grep -qF "plumbline_add_renderer_tests: $2" || { # CMake breaks lines
    cat refused/log
    fail "expected '$2' of plumbline_add_renderer_tests($1)"
  }
}
refused 'none;SCENES;fan.json' 'none: expected a program that add_executable() made, found no target'
refused 'no_program;SCENES;fan.json' 'no_program: expected a program that add_executable() made, found INTERFACE_LIBRARY'
refused 'my_program;SCENE;fan.json' 'expected SCENES, CALL, OPTIONS or SKIP_UNSUPPORTED, found SCENE;fan.json'
refused 'my_program;SCENES' 'SCENES: expected a value, found none'
refused 'my_program' 'expected SCENES and at least one scene'
refused 'my_program;SCENES;none.json' 'none.json: expected a scene (.json) or a folder that holds some, in'
refused 'my_program;SCENES;fan[1].json' 'expected names of scenes without brackets'
refused "my_program;SCENES;$folder/one/fan.json;$folder/two/fan.json" "$folder/two/fan.json: expected a scene of another name"
echo "installed in $prefix: used"
