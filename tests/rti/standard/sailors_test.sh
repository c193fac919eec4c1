#!/bin/sh
# Two federates of the standard's API, compiled as C++14, meet at a hosted RTI: sailors_test.sh RTI SAILOR MODEL WORK
set -eu
rti=$1 sailor=$2 model=$3 work=$4
mkdir -p "$work" && rm -f "$work"/*  # of an earlier run: its RTI is elsewhere
"$rti" --fom "$model" --listen 127.0.0.1:0 >"$work/rti" 2>&1 &
host=$!
trap 'kill $host 2>/dev/null || true' EXIT
for _ in $(seq 100); do grep -q listening "$work/rti" && break; sleep 0.1; done
RINK_RTI=$(sed -n 's/^listening on //p' "$work/rti")
export RINK_RTI
"$sailor" "$model" captain >"$work/captain" 2>&1 &
captain=$!
"$sailor" "$model" >"$work/visitor" 2>&1 || { cat "$work/visitor"; exit 1; }
wait $captain || { cat "$work/captain"; exit 1; }
cat "$work/visitor"
grep -q '^a ship at [0-9], 7$' "$work/visitor"

# Who finds no RTI, or no model, is told so.
status=0; RINK_RTI=127.0.0.1:1 "$sailor" "$model" >"$work/lost" 2>&1 || status=$?
[ $status -eq 1 ] && grep -q "no RTI at 127.0.0.1:1" "$work/lost"
status=0; "$sailor" no-such-model.xml >"$work/lost" 2>&1 || status=$?
[ $status -eq 1 ] && grep -q "no-such-model.xml" "$work/lost"
