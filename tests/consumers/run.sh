#!/usr/bin/env bash
# Builds and runs program.cpp against derham as a consumer would, and compares what it prints with expected.txt.
#
#   run.sh find_package|add_subdirectory|pkg_config SOURCE_DIR BUILD_DIR WORK_DIR COMPILER [FLAGS]
set -euo pipefail
way=$1 source=$2 build=$3 work=$4 compiler=$5 flags=${6:-}
here=$source/tests/consumers
rm -rf "$work"
mkdir -p "$work"

# Installs, then moves the tree: an installed derham may not remember where it was installed or built.
install_and_move() {
  cmake --install "$build" --prefix "$work/first" >"$work/install.log"
  mv "$work/first" "$work/prefix"
  # As whole paths: a source in /derham is not named by ${prefix}/include/derham.
  local paths="(?<![\w}./-])(\Q$build\E|\Q$source\E|\Q$work/first\E)(?![\w-])"
  if grep -rlP -e "$paths" "$work/prefix/include" "$work/prefix/lib"*/*/; then
    echo "the files above name the build tree" >&2
    exit 1
  fi
  local header missing=0
  while read -r header; do
    [ -f "$work/prefix/include/$header" ] || { echo "an installed header includes $header, which is not installed"; missing=1; }
  done < <(grep -rhoE '#include "derham/[^"]+"' "$work/prefix/include" | sed -E 's/.*"(.*)"/\1/' | sort -u)
  [ $missing -eq 0 ]
}

check() {
  "$1" >"$work/output.txt"
  diff "$here/expected.txt" "$work/output.txt"
}

case $way in
  find_package)
    install_and_move
    cmake -S "$here/find_package" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" \
      -DCMAKE_PREFIX_PATH="$work/prefix"
    cmake --build "$work/build"
    check "$work/build/program"
    if [ -x "$work/prefix/bin/derham" ]; then "$work/prefix/bin/derham" --version; fi
    ;;
  add_subdirectory)
    cmake -S "$here/add_subdirectory" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_CXX_FLAGS="$flags" -DDERHAM_SOURCE_DIR="$source"
    cmake --build "$work/build"
    check "$work/build/program"
    ;;
  pkg_config)
    install_and_move
    for options in "" --static; do
      PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name derham.pc)") \
        "$here/pkg_config/build.sh" "$compiler $flags" "$here/program.cpp" "$work/program" $options
      check "$work/program"
    done
    ;;
  *) echo "unknown way '$way'" >&2; exit 2 ;;
esac
echo "$way: the program built and printed what it should"
