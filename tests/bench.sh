#!/bin/sh
# make bench: user seconds and peak memory of each stage, medians of $BENCH_RUNS runs (3), one process
# at a time. Scenes are tests/bench/*.yaml (of tests/bench/labels/ the first stage only); @SHARED@ in them is the folder of real material.
set -u
runs=${BENCH_RUNS:-3}
shared=${STAFFAGE_SHARED:-$top_srcdir/../shared}
[ -f "$shared/data/README.md" ] || { echo "bench: needs the photographs of $shared (or \$STAFFAGE_SHARED)" >&2; exit 1; }
shared=$(cd "$shared" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

median() { sort -n | awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }

# measure STAGE COMMAND...: append user seconds and peak kilobytes.
measure() {
    stage=$1
    shift
    /usr/bin/time -o "$work/time" -f '%U %M' "$@" >"$work/log" 2>&1 </dev/null || { cat "$work/log" >&2; exit 1; }
    read -r user_s peak_kb <"$work/time"
    echo "$user_s" >>"$work/$stage.user"
    echo "$peak_kb" >>"$work/$stage.peak"
}

printf '%-28s %9s %9s %9s %9s %9s\n' scene generate render post total 'peak MB'
for scene in "$top_srcdir"/tests/bench/*.yaml; do
    name=$(basename "$scene" .yaml)
    sed "s|@SHARED@|$shared|g" "$scene" >"$work/$name.yaml"
    rm -f "$work"/*.user "$work"/*.peak
    i=0
    while [ $i -lt "$runs" ]; do
        rm -rf "$work/out"
        measure generate "$top_builddir/staffage" generate "$work/$name.yaml" -o "$work/out"
        measure render "$top_builddir/staffage" render "$work/out" -j 1
        measure post "$top_builddir/staffage" post "$work/out" -j 1
        i=$((i + 1))
    done
    generate=$(median <"$work/generate.user") render=$(median <"$work/render.user") post=$(median <"$work/post.user")
    peak=$(cat "$work"/*.peak | sort -n | tail -n 1)
    echo "$name $generate $render $post $peak" | awk '{
        total = $2 + $3 + $4
        printf "%-28s %7.2f s %7.2f s %7.2f s %7.2f s %9.0f\n", $1, $2, $3, $4, total, $5 / 1024
        printf "%-28s %7.0f %% %7.0f %% %7.0f %%\n", "", 100 * $2 / total, 100 * $3 / total, 100 * $4 / total
    }'
done

# The first stage alone, where the labels are traced: scenes, models and photograph included.
for scene in "$top_srcdir"/tests/bench/labels/*.yaml; do
    name=$(basename "$scene" .yaml)
    sed "s|@SHARED@|$shared|g" "$scene" >"$work/$name.yaml"
    rm -f "$work"/*.user "$work"/*.peak
    i=0
    while [ $i -lt "$runs" ]; do
        rm -rf "$work/out"
        measure generate "$top_builddir/staffage" generate "$work/$name.yaml" -o "$work/out"
        i=$((i + 1))
    done
    median <"$work/generate.user" | awk -v name="$name" '{ printf "%-28s %7.2f s\n", name " labels", $1 }'
done

# The place as mesh, by its size.
echo
"$top_builddir/tests/bench/place.bench" "$shared/data/brighton/mesh.ply" 8.3 "$work"
