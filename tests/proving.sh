#!/bin/sh
# The proving ground (docs/fidelity.md), small and rough: one photograph, every transfer, and how near they come to the truth.
. "$top_srcdir/tests/tap.sh"
here=$PWD
PROVING_WIDTH=240 PROVING_FINENESS=1.3 PROVING_FINE=0
export PROVING_WIDTH PROVING_FINENESS PROVING_FINE
prove() { ( cd "$top_builddir" && "$top_srcdir/scenes/proving-ground/prove" -o "$here/ground" plane-noon ); }
run prove
check "a street is photographed, enriched and compared with its truth" is $status 0

# figure METHOD COLUMN, as comparison_print writes them.
figure() { awk -v method="$1" -v column="$2" '$3 == method { print $column }' ground/plane-noon/figures-known; }
psnr=5 ssim=6 shade=8 color=11 mask=12 amodal=13 depth=14 box=16 amodal_box=17 share=18 semantic=19 position=20 turn=21 size=22 corner=23 edge_width=25
# within FIGURE LEAST MOST
within() { awk -v f="$1" -v least="$2" -v most="$3" 'BEGIN { exit !(f != "" && f >= least && f <= most) }'; }
# labelled BEHAVIOUR COLUMN LEAST MOST
labelled() {
    value=$(figure layers $2)
    check "$1 ($value)" within "$value" $3 $4
}
labelled "masks are POV-Ray's own, pixel by pixel" $mask 0.999 1
labelled "whole masks, too" $amodal 0.999 1
labelled "depth is POV-Ray's within half of its picture's steps" $depth 0 0.0016
labelled "boxes of what is visible" $box 0 0
labelled "boxes of what is there" $amodal_box 0 0
labelled "what share of each is visible" $share 0 0.001
labelled "classes" $semantic 1 1
labelled "poses: position, m" $position 0 0.0001
labelled "poses: turn, deg" $turn 0 0.001
labelled "sizes, m" $size 0 0.0001
labelled "corners of 3D boxes in the picture, px" $corner 0 0.01

# At this size pixels are as large as a car's lamp; what full size gives is in docs/fidelity.md.
for method in layers ratio threshold alpha; do
    echo "# $method: PSNR $(figure $method $psnr) dB, SSIM $(figure $method $ssim), shade $(figure $method $shade), colour $(figure $method $color)"
done
labelled "layers: PSNR, dB" $psnr 29 99
labelled "layers: what is left of the light, mean distance" $shade 0 0.045
labelled "layers: colours of entities, CIE 1976 distance" $color 0 2.5
labelled "layers: edges are as wide as the truth's" $edge_width 0.85 1.15
for method in ratio threshold alpha; do
    check "layers come nearer than $method" within "$(figure layers $psnr)" "$(figure $method $psnr)" 99
done
tap_done
