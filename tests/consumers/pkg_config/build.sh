#!/usr/bin/env bash
# usage: build.sh COMPILER SOURCE PROGRAM [PKG_CONFIG_OPTION…]; the compiler may carry flags, and PKG_CONFIG_PATH is set.
set -euo pipefail
read -ra compile <<<"$1"
read -ra flags <<<"$(pkg-config "${@:4}" --cflags --libs derham) $(pkg-config --cflags eigen3 | sed 's/-I */-isystem /g')"
"${compile[@]}" -std=c++20 "$2" "${flags[@]}" -o "$3"
