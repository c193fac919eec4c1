#!/bin/sh
# The driver of bench/standard against a hosted RTI: driver_test.sh RTI DRIVER MODEL WORK
set -eu
rti=$1 driver=$2 model=$3 work=$4
mkdir -p "$work" && rm -f "$work"/*  # of an earlier run: its RTI is elsewhere
"$rti" --fom "$model" --listen 127.0.0.1:0 >"$work/rti" 2>&1 &
host=$!
trap 'kill $host 2>/dev/null || true' EXIT
for _ in $(seq 100); do grep -q listening "$work/rti" && break; sleep 0.1; done
place=$(sed -n 's/^listening on //p' "$work/rti")
"$driver" "$model" "$place" >"$work/table"
cat "$work/table"
[ "$(grep -c 'all right$' "$work/table")" -eq 6 ]

# What cannot be measured is said in its row, and by the status.
status=0; "$driver" "$model" 127.0.0.1:1 >"$work/lost" || status=$?
[ $status -eq 1 ] && grep -q '^joins  *0 .*no RTI at 127.0.0.1:1' "$work/lost"
for wrong in "" "$model a b" "$model --scale 0" "$model --fast"; do
  status=0; "$driver" $wrong >/dev/null 2>&1 || status=$?
  [ $status -eq 2 ] || { echo "status $status for '$wrong'"; exit 1; }
done
