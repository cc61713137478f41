# Sourced by the tests of programs: $bin is the folder of the programs, $work a folder of the test's own.
set -u
bin=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# expect CODE WORDS COMMAND...: the exit code, the words on stderr or stdout, and one line where input is refused.
expect() {
  local code=$1 words=$2
  shift 2
  "$@" >"$work/out" 2>"$work/err"
  local got=$?
  [[ $got == "$code" ]] || fail "$* exited with $got instead of $code: $(head -c 300 "$work/err")"
  grep -qF -- "$words" "$work/out" "$work/err" || fail "$* did not say '$words' but: $(head -c 300 "$work/err")"
  if [[ $code == 2 && $(grep -c . "$work/err") != 1 ]]; then
    fail "$* said more than one sentence: $(head -c 600 "$work/err")"
  fi
}
