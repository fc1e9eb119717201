#!/bin/sh
# Every vehicle of the cast near, farther and far on the sunny street: `scenes/craig/fleet.sh OUT [NAME ...]`, from the top of the build tree.
# Each picture has three vehicles, so that each of them is at each distance once. It needs the photographs of ../shared ($STAFFAGE_SHARED).
set -eu
[ $# -gt 0 ] || { echo "usage: $0 OUT [NAME ...]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
shared=$(cd "${STAFFAGE_SHARED:-$here/../../../shared}" && pwd)
out=$1
shift
all='sedan hatchback estate suv minivan van pickup taxi box-truck city-bus ambulance fire-truck dump-truck motorcycle bicycle'
mkdir -p "$out"

# The N-th after a name, around.
after() {
    echo "$all" | awk -v name="$1" -v n="$2" '{ for (i = 1; i <= NF; i++) if ($i == name) print $((i - 1 + n) % NF + 1) }'
}

for name in ${*:-$all}; do
    scene=$out/$name.yaml
    sed -n -e "s#\.\./\.\./\.\./shared#$shared#" -e '/^models:/q' -e p "$here/sunny.yaml" > "$scene"
    {
        echo 'entities:'
        echo "  - { name: near, model: $name, at: { pixel: [640, 830] }, heading_deg: 41 }"
        echo "  - { name: middle, model: $(after "$name" 5), at: { pixel: [1120, 560] }, heading_deg: 232 }"
        echo "  - { name: far, model: $(after "$name" 10), at: { pixel: [915, 395] }, heading_deg: 47 }"
        sed -n '/^# The cables/,$p' "$here/sunny.yaml"
    } >> "$scene"
    ./staffage run "$scene" -o "$out/$name" -j 1
done
