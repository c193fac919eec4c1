#!/bin/sh
# Writes a man page for the launcher and each command from its --help and --version: man_pages.sh LAUNCHER PROGRAMS OUT COMMAND...
set -eu
launcher=$1 programs=$2 out=$3
shift 3
mkdir -p "$out"
rm -f "$out"/*.1 "$out"/*.1.gz
help2man --no-info --name 'scalability testbed for interest management' --output "$out/rink.1" "$launcher"
for command in "$@"; do
  summary=$("$launcher" help | sed -n "s/^  $command  *//p")
  [ -n "$summary" ] || { echo "man_pages.sh: '$command' is not in the list that '$launcher help' prints" >&2; exit 1; }
  help2man --no-info --name "$summary" --output "$out/rink-$command.1" "$programs/rink-$command"
done
gzip -9n "$out"/*.1
