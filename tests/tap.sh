# The Test Anything Protocol for shell tests: source it, call ok, end with tap_done.
# A test program runs in $work, a fresh folder that goes away with it.
set -u
unset MAKEFLAGS MFLAGS MAKELEVEL
tap_count=0
tap_failed=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

# ok STATUS "behaviour": what was printed last, in $work/log, is shown when it failed.
ok() {
    tap_count=$((tap_count + 1))
    if [ "$1" = 0 ]; then
        echo "ok $tap_count - $2"
    else
        tap_failed=$((tap_failed + 1))
        echo "not ok $tap_count - $2"
        [ ! -f "$work/log" ] || sed 's/^/# /' "$work/log"
    fi
}

# check "behaviour" COMMAND...: the command's status is what counts.
check() {
    behaviour=$1
    shift
    "$@"
    ok $? "$behaviour"
}

skip() {
    tap_count=$((tap_count + 1))
    echo "ok $tap_count - $1 # SKIP $2"
}

# run COMMAND...: what it prints goes to the log, its status to $status.
run() {
    "$@" >"$work/log" 2>&1 </dev/null
    status=$?
}

says() { grep -q -e "$1" "$work/log"; }
is() { [ "$1" = "$2" ]; }
not() { ! "$@"; }

tap_done() {
    echo "1..$tap_count"
    [ $tap_failed = 0 ]
    exit
}
