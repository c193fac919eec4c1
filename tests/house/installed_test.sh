#!/bin/sh
# The installed launcher runs the commands that stand beside it and needs no source tree: installed_test.sh CMAKE BUILD WORK VERSION
set -eu
cmake=$1 build=$2 work=$3 version=$4
fail() { echo "$*" >&2; exit 1; }
status_of() { status=0; "$@" >"$work/output" 2>&1 || status=$?; echo "$status"; }

rm -rf "$work"
mkdir -p "$work"
"$cmake" --install "$build" --component commands --prefix "$work/prefix" >/dev/null
cd "$work"
PATH=$work/prefix/bin:$PATH
case $(rink --version) in "rink $version (commit "*) ;; *) fail "rink --version says '$(rink --version)'" ;; esac
[ "$(status_of rink simulate match --until 0.1)" -eq 0 ] || fail "rink simulate: $(cat output)"
grep -q '"engine": "exact"' output || fail "rink simulate wrote: $(cat output)"
[ "$(status_of rink test)" -eq 2 ] && grep -q "needs the source tree" output || fail "rink test: $(cat output)"
[ "$(status_of rink fly)" -eq 2 ] && grep -q "there is no command 'fly'" output || fail "rink fly: $(cat output)"

# Completion offers what --help lists.
completed() {
  bash -c 'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _rink "$1"; echo "${COMPREPLY[@]}"' prefix/share/bash-completion/completions/rink "$@"
}
[ "$(completed rink sim)" = simulate ] || fail "rink sim<Tab>: $(completed rink sim)"
[ "$(completed rink simulate --ev)" = --events ] || fail "rink simulate --ev<Tab>: $(completed rink simulate --ev)"
[ "$(completed rink-bots --count)" = --count ] || fail "rink-bots --count<Tab>: $(completed rink-bots --count)"
rm -rf "$work"
