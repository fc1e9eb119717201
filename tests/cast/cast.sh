#!/bin/sh
# staffage-cast by itself: this very build's, which may have taken its models over from another.
. "$top_srcdir/tests/tap.sh"
cast=$top_builddir/staffage-cast

run "$cast" some boy-6 motorcycle
check "models are made by name: exit status 0" is $status 0
check "these alone, in three levels of detail" is "$(ls some | tr '\n' ' ')" \
    "boy-6-far.glb boy-6-middle.glb boy-6.glb catalogue.json motorcycle-far.glb motorcycle-middle.glb motorcycle.glb "
check "listed in the cast's own order" is "$(sed -n 's/.*"name": "\(.*\)".*/\1/p' some/catalogue.json | tr '\n' ' ')" "motorcycle boy-6 "
same=yes
for file in some/*.glb; do
    cmp "$file" "$top_builddir/models/${file#some/}" >>log || same=no
done
check "alone or among all, the same bytes" is $same yes
run "$cast" none nobody
check "a name that nobody has is refused, and nothing is made" test $status = 1 -a ! -e none
check "by name" says 'nobody in the cast is called "nobody"'
run "$cast"
check "without a folder it is wrong usage" is $status 2
tap_done
