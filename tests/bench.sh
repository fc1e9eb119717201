#!/bin/sh
# make bench: user seconds and peak memory of each stage, medians of $BENCH_RUNS runs (3), one process
# at a time. Scenes are tests/bench/*.yaml, of tests/bench/labels/ the first stage only, @SHARED@ in them
# is the folder of real material; and scenes/brighton with another mesh, other photographs, more traffic.
set -u
runs=${BENCH_RUNS:-3}
shared=${STAFFAGE_SHARED:-$top_srcdir/../shared}
[ -f "$shared/data/README.md" ] || { echo "SKIP: bench: needs the photographs of $shared (or \$STAFFAGE_SHARED)"; exit 0; }
shared=$(cd "$shared" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
STAFFAGE_POVRAY=$top_builddir/staffage-povray
export STAFFAGE_POVRAY

median() { sort -n | awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }
# user NAME STAGE: the median of what was measured.
user() { median <"$work/$1.$2.user"; }
peak_mb() { cat "$work/$1".*.peak | sort -n | awk 'END { print $1 / 1024 }'; }

# measure NAME STAGE COMMAND...: note user seconds and peak kilobytes.
measure() {
    into=$work/$1.$2
    shift 2
    /usr/bin/time -o "$work/time" -f '%U %M' "$@" >"$work/log" 2>&1 </dev/null || { cat "$work/log" >&2; exit 1; }
    read -r user_s peak_kb <"$work/time"
    echo "$user_s" >>"$into.user"
    echo "$peak_kb" >>"$into.peak"
}

# stages NAME STAGE...: once through a scene, $work/NAME.yaml.
stages() {
    name=$1
    shift
    rm -rf "$work/out"
    for stage; do
        case $stage in
        generate) measure "$name" generate "$top_builddir/staffage" generate "$work/$name.yaml" -o "$work/out" ;;
        *) measure "$name" "$stage" "$top_builddir/staffage" "$stage" "$work/out" -j 1 ;;
        esac
    done
}

# often NAME STAGE...
often() {
    for run in $(seq "$runs"); do stages "$@"; done
}

# scene FILE: its name, and $work/NAME.yaml.
scene() {
    name=$(basename "$1" .yaml)
    sed "s|@SHARED@|$shared|g" "$1" >"$work/$name.yaml"
}

printf '%-28s %9s %9s %9s %9s %9s\n' scene generate render post total 'peak MB'
for file in "$top_srcdir"/tests/bench/*.yaml; do
    scene "$file"
    often "$name" generate render post
    echo "$name $(user "$name" generate) $(user "$name" render) $(user "$name" post) $(peak_mb "$name")" | awk '{
        total = $2 + $3 + $4
        printf "%-28s %7.2f s %7.2f s %7.2f s %7.2f s %9.0f\n", $1, $2, $3, $4, total, $5
        printf "%-28s %7.0f %% %7.0f %% %7.0f %%\n", "", 100 * $2 / total, 100 * $3 / total, 100 * $4 / total
    }'
done

# The first stage alone, where the labels are traced: scenes, models and photograph included.
for file in "$top_srcdir"/tests/bench/labels/*.yaml; do
    scene "$file"
    often "$name" generate
    printf '%-28s %7.2f s\n' "$name labels" "$(user "$name" generate)"
done

# The place as mesh, by its size.
echo
"$top_builddir/tests/bench/place.bench" "$shared/data/brighton/mesh.ply" 8.3 "$work" || exit 1

# --- a flight ---

# flight NAME WIDTH_PX MESH VEHICLES PEOPLE: a scene of brighton.
flight() {
    photographs=$work/$2
    if [ ! -d "$photographs" ]; then
        mkdir "$photographs"
        for jpg in "$shared"/data/brighton/images/*.JPG; do
            "$top_builddir/tests/bench/resize.bench" "$2" "$jpg" "$photographs/$(basename "$jpg" .JPG).jpg" || exit 1
        done
    fi
    sed -e "s|\.\./\.\./\.\./shared/data/brighton/images/\(.*\)\.JPG|$photographs/\1.jpg|" -e "s|mesh: .*|mesh: $3|" \
        -e "s|\.\./\.\./\.\./shared|$shared|" -e "s|\.\./\.\./models|$(cd "$top_builddir" && pwd)/models|" \
        -e "s|^    count: .*|    count: $4|" -e "s|people: { count: [0-9]*|people: { count: $5|" \
        "$top_srcdir/scenes/brighton/scene.yaml" >"$work/$1.yaml"
    flights="$flights $1"
}

# Once through one frame, pass by pass; what two frames more cost generate, and what it does when all is there.
frame=000009
fly() {
    rm -rf "$work/out" "$work/three"
    generate="$top_builddir/staffage generate $work/$1.yaml"
    measure "$1" one $generate -o "$work/out" --frames 9:10
    measure "$1" load $generate -o "$work/out" --frames 9:10
    measure "$1" three $generate -o "$work/three" --frames 9:12
    for pass in object plane shadow; do measure "$1" $pass make -s -C "$work/out" frames/$frame/$pass.exr; done
    measure "$1" post "$top_builddir/staffage" post "$work/out" -j 1
}

# flown TITLE: all flights' figures, each against the first; the runs go round, for machines that slow down.
flown() {
    for run in $(seq "$runs"); do
        for f in $flights; do fly "$f"; done
    done
    printf '\n%-16s %8s %8s %8s %8s %8s %8s %8s %6s %8s\n' "$1" load generate object plane shadow post frame ratio 'peak MB'
    first=
    for f in $flights; do
        : "${first:=$f}"
        for s in one load three object plane shadow post; do user "$f" $s; done | tr '\n' ' '
        for s in one three object plane shadow post; do user "$first" $s; done | tr '\n' ' '
        peak_mb "$f" | sed "s/\$/ $f/"
    done | awk '{
        generate = ($3 - $1) / 2
        frame = generate + $4 + $5 + $6 + $7
        printf "%-16s %6.2f s %6.2f s %6.2f s %6.2f s %6.2f s %6.2f s %6.2f s %6.2f %8.0f\n",
            $15, $2, generate, $4, $5, $6, $7, frame, frame / (($9 - $8) / 2 + $10 + $11 + $12 + $13), $14
        printf "%-16s %8s %6.0f %% %6.0f %% %6.0f %% %6.0f %% %6.0f %%\n", "", "", 100 * generate / frame,
            100 * $4 / frame, 100 * $5 / frame, 100 * $6 / frame, 100 * $7 / frame
    }'
    flights=
}

mesh=$shared/data/brighton/mesh.ply
flights=
flight 256k-triangles 2000 "$mesh" 12 12
flight 1M-triangles 2000 "$work/place-0.ply" 12 12
flight 4M-triangles 2000 "$work/place-1.ply" 12 12
flown mesh
flight 1000px 1000 "$mesh" 12 12
flight 2000px 2000 "$mesh" 12 12
flight 4000px 4000 "$mesh" 12 12
flown image
flight 6-entities 2000 "$mesh" 2 4
flight 12-entities 2000 "$mesh" 4 8
flight 24-entities 2000 "$mesh" 8 16
flight 48-entities 2000 "$mesh" 16 32
flown traffic
