# Sourced by the tests of windows: $bin is the folder of the programs, $work a folder of the test's own, DISPLAY a virtual
# display of its own, too.
set -u
bin=$1
work=$(mktemp -d)
for tool in Xvfb xdotool; do
  command -v $tool >/dev/null || { echo "FAILED: $tool is missing (see tools/test_packages.txt)"; exit 1; }
done
mkfifo "$work/display"
# Without -noreset the server begins anew when its last window closes, and refuses who comes meanwhile.
Xvfb -noreset -displayfd 3 -screen 0 1024x768x24 3>"$work/display" >/dev/null 2>&1 &
xvfb=$!
read -r number <"$work/display"
export DISPLAY=:$number
export XDG_CONFIG_HOME=$work/config  # what programs remember is this test's
finish() {
  kill "$xvfb" 2>/dev/null
  rm -rf "$work"
}
trap finish EXIT

# Sets $window once a window of ours is there; fails where none comes.
await_window() {
  window=
  for _ in $(seq 100); do
    window=$(xdotool search --onlyvisible --name Afterglow 2>/dev/null | head -1)
    [[ -n $window ]] && return 0
    sleep 0.2
  done
  return 1
}
