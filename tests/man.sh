#!/bin/sh
# The manual and the programs' --help name the same options, and the manual's example is a scene.
. "$top_srcdir/tests/tap.sh"

# The options that head a line of --help: "  -o, --output OUT    text".
help_options() { sed -n 's/^ *\(-.*\)/\1/p' log | sed 's/   *[^-].*//' | grep -o -e '--*[A-Za-z][A-Za-z-]*' | sort -u; }
# The options that head an entry of the page: ".It Fl o , Fl -output Ar OUT".
page_options() { sed -n 's/^\.It \(Fl .*\)/\1/p' "$1" | grep -o -e 'Fl -*[A-Za-z][A-Za-z-]*' | sed 's/^Fl /-/' | sort -u; }

for program in staffage staffage-fuse staffage-gen staffage-import staffage-models staffage-post staffage-povray staffage-stats; do
    page=$top_srcdir/man/$program.1
    run "$top_builddir/$program" --help
    help_options >help
    page_options "$page" >page
    check "$program: --help names options" test $status = 0 -a -s help
    diff help page >log
    ok $? "$program: --help and the manual name the same options"
    run "$top_builddir/$program" --version
    check "$program: --version" says "^$program [0-9]*\.[0-9]*\.[0-9]*\$"
    run "$top_builddir/$program" --no-such-option
    check "$program: an unknown option is wrong usage" is $status 2
    if command -v groff >/dev/null; then
        run groff -mandoc -Tascii -ww -z "$page"
        check "$program: the page is formatted without a warning" test $status = 0 -a ! -s log
    else
        skip "$program: the page is formatted without a warning" "no groff"
    fi
done

sed -n '/^\.Bd/,/^\.Ed/p' "$top_srcdir/man/staffage-scene.5" | grep -v '^\.' >scene.yaml
cp "$top_srcdir/tests/input/street.png" street.jpg
cp "$top_srcdir/tests/input/box.obj" hatchback.obj
sed -i 's/2000, 1500/64, 48/; s/900, 1000, 1100, 1100/10, 30, 50, 46/; s/700, 900/32, 36/' scene.yaml
STAFFAGE_DATADIR=$top_srcdir
export STAFFAGE_DATADIR
run "$top_builddir/staffage-gen" scene.yaml -o out
check "staffage-scene: its example is a scene" is $status 0
tap_done
