#!/bin/sh
# Flights whose positions do not tell where they were, through staffage-import: the exact messages.
. "$top_srcdir/tests/tap.sh"

mkdir -p flight/sparse flight/images
echo '1 PINHOLE 200 100 180 180 100 50' >flight/sparse/cameras.txt
printf '%s\n\n' '1 1 0 0 0 0 0 0 1 a.jpg' '2 1 0 0 0 -1 0 0 1 b.jpg' '3 1 0 0 0 0 -1 0 1 c.jpg' >flight/sparse/images.txt
: >flight/sparse/points3D.txt
for image in a b c; do printf '\377\330\377\331' >flight/images/$image.jpg; done

# refused "behaviour" OPTION... : the message is read from standard input.
refused() {
    behaviour=$1
    shift
    cat >want
    "$top_builddir/staffage-import" colmap flight/sparse -o flight.yaml "$@" >out 2>log </dev/null
    is $? 1 && cmp -s log want && not test -e flight.yaml
    ok $? "$behaviour"
}

refused "photographs without GPS: how many have it, and what else can be given" <<'END'
staffage-import: 0 of 3 photographs have a GPS position in their EXIF, and it takes 3. Copies that lost their EXIF? Give the originals' folder, or control points, or one known distance
END

cat >points.txt <<'END'
# name x y z latitude longitude height
church 0 0 0 47 8 500
bridge 1 0 0 47 8.0001 500
END
refused "two control points are too few" --georeference points.txt <<'END'
points.txt: 2 positions are given, church and bridge: scale, turn and place take at least 3 that are not on one line
END

echo 'mill 2 0 0 47 8.0002 500' >>points.txt
refused "control points on one line, and how far they spread" --georeference points.txt <<'END'
points.txt: the positions lie on one line: 3 of them spread over 15.2 m along and 0 m across, with a noise of 0.19 m, so the turn about that line is not determined at all (3 deg are wanted). Fly a second line beside the first, or give control points off it
END

cat >points.txt <<'END'
A 0 0 0 47 8 500
B 1 0 0 47 8.0001 500
C 0 1 0 47.0002 8.0002 560
D 1 1 0 47.01 7 0
END
refused "control points that contradict each other are named" --georeference points.txt <<'END'
points.txt: the positions contradict each other: no more than 0 of 4 agree within 1 m with the reconstruction's shape, and it takes 3 and half of them. These do not: A (20.6 m off), B (14.6 m off), C (14.6 m off), D (7.61e+04 m off)
END

echo 'E 1 1 0 47.01 7° 0' >>points.txt
refused "a control point that is no number, at its line and column" --georeference points.txt <<'END'
points.txt:5:15: LONGITUDE is "7°", which is no number; a line is NAME X Y Z LATITUDE LONGITUDE HEIGHT
END

tap_done
