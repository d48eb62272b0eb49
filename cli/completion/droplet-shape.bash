# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of droplet-shape for bash. Made by scripts/make-docs.

_droplet_shape()
{
    COMPREPLY=()
    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}
    # bash splits --option=value into three words.
    if [[ $word == = ]]; then
        word=
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD-2]}
    fi
    local options choices= files=
    case $command in
        animate) options='--volume-mode --fps --contact-sheet --reveal --drips --seed --feed --slow --frames --preview --view --camera --look-at --preview-size --codec --quality --width --pixel-size --channel --threshold --invert --segment --colour --smooth --fill-holes --keep --speck-size --contact-angle --on --volume --height --fill --liquid --surface-tension --density --model --gravity --tilt --tilt-direction --surface --surface-depth --no-penetration --onto --scale --object-size --up --advancing --receding --triangles --edge --grading --open --material --unit --lod --compress --html --json --resume --no-clobber --solver --threads --quiet --verbose --progress --config --help --version' ;;
        batch) options='--output --recursive --json --keep-going --no-resume --shard --manifest --contact-sheet --same-scale --width --pixel-size --channel --threshold --invert --segment --colour --smooth --fill-holes --keep --speck-size --by-colour --colours --gap --seeds --mask-out --contact-angle --on --volume --height --fill --liquid --surface-tension --density --model --gravity --tilt --tilt-direction --surface --surface-depth --no-penetration --onto --scale --object-size --up --advancing --receding --triangles --edge --grading --open --material --unit --quads --format --nodes --droplets-only --materials --fill-range --sink --base --lod --weld --compress --colour-map --no-clobber --solver --threads --quiet --verbose --progress --config --help --version' ;;
        compare) options='--tolerance --volume-tolerance --normal-tolerance --json --picture --no-clobber --threads --quiet --config --help --version' ;;
        dew) options='--scale --object-size --up --preset --coverage --smallest --largest --sizes --median --spread --from --mask --vertex-weights --inside --seed --hysteresis --pinning --pinning-length --gravity-direction --contact-angle --viscosity-factor --kinetic-fraction --drag-coefficient --boundary-layer --profile-exponent --air-density --liquid --surface-tension --density --gravity --detail --material --instancing --droplets-only --compress --droplets --json --preview --view --camera --look-at --preview-size --environment --turntable --codec --quality --no-clobber --progress --threads --quiet --config --help --version' ;;
        flow) options='--preset --scale --object-size --up --floor --spin --spin-axis --motion --object-animation --no-animation --drops --volume --radius --volume-spread --from --mask --vertex-weights --start --emitter --rain --condensation --dew-spacing --retention --hysteresis --pinning --pinning-length --friction --roughness --roughness-map --friction-map --ground --adhesion --gravity-direction --wind-velocity --no-merge --no-wetting --film --bead-spacing --drying --contact-angle --viscosity-factor --kinetic-fraction --drag-coefficient --boundary-layer --profile-exponent --air-density --liquid --surface-tension --density --gravity --time --fps --seed --shape --deformation --material --compress --streaks --maps --map-width --map-thickness --map-age --droplets --html --json --preview --view --camera --look-at --preview-size --environment --turntable --codec --quality --resume --no-clobber --progress --threads --quiet --config --help --version' ;;
        glyphs) options='--font --face-index --axis --text --charset --all --list --output --em --tolerance --align --line-sizes --line-spacing --tracking --line-width --arc --path --path-width --shift --equal-height --by-colour --palette --text-colour --gap --json --keep-going --no-resume --shard --manifest --contact-sheet --same-scale --contact-angle --on --volume --height --fill --liquid --surface-tension --density --model --gravity --tilt --tilt-direction --surface --surface-depth --no-penetration --onto --scale --object-size --up --advancing --receding --triangles --edge --grading --open --material --unit --quads --format --nodes --droplets-only --materials --fill-range --sink --base --lod --weld --compress --preview --view --camera --look-at --preview-size --ground --environment --preview-background --preview-colour --turntable --codec --quality --maps --map-width --map-thickness --map-tile --html --no-clobber --solver --threads --quiet --verbose --progress --config --help --version' ;;
        liquid2d) options='--scene --particle-count --walls --gravity --surface-tension --solver --particles --particle-scale --plane --spacing --time --begin --loop --fps --hold --style --tail --tail-slope --max-tail --claws --air --release --max-air --eraser-share --no-crest-gate --smoothing --fairing --resolution --frame-width --look --line-width --least-droplet --masks --particle-cache --codec --quality --alpha --json --resume --no-clobber --progress --threads --quiet --config --help --version' ;;
        morph) options='--text --font-family --frames --particle-count --rounding --mask-width --look --alpha --volume-mode --fps --contact-sheet --preview --view --camera --look-at --preview-size --codec --quality --width --pixel-size --channel --threshold --invert --segment --colour --smooth --fill-holes --keep --speck-size --contact-angle --on --volume --height --fill --liquid --surface-tension --density --model --gravity --tilt --tilt-direction --surface --surface-depth --no-penetration --onto --scale --object-size --up --advancing --receding --triangles --edge --grading --open --material --unit --lod --compress --html --json --resume --no-clobber --solver --threads --quiet --verbose --progress --config --help --version' ;;
        studio) options='--no-clobber --help' ;;
        wind-tunnel) options='--preset --volume --wind-speed --slope --hysteresis --sliding-angle --sliding-volume --contact-angle --viscosity-factor --kinetic-fraction --drag-coefficient --boundary-layer --profile-exponent --air-density --liquid --surface-tension --density --gravity --chart --map --measured --trace --time --trace-step --initial-speed --gust --gust-period --json --no-clobber --threads --quiet --config --help --version' ;;
        windshield) options='--preset --rain --mist --speed --drive-cycle --wind-model --noise --wiper-period --splashes --seed --glass-width --glass-height --glass-radius --slope --surface --hysteresis --still-diameter --film --runoff --shape --contact-angle --viscosity-factor --kinetic-fraction --drag-coefficient --boundary-layer --profile-exponent --air-density --liquid --surface-tension --density --gravity --time --warm-up --fps --background --fit --environment --background-blur --frame-size --field-of-view --eye-distance --eye --look-at --samples --exposure --highlight-boost --shutter --layer --codec --quality --maps --map-width --map-thickness --droplets --moving-only --animation --animation-method --compress --live --json --resume --no-clobber --progress --threads --quiet --config --help --version' ;;
        *) options='--width --pixel-size --channel --threshold --invert --segment --colour --smooth --fill-holes --keep --speck-size --by-colour --colours --gap --seeds --mask-out --contact-angle --on --volume --height --fill --liquid --surface-tension --density --model --gravity --tilt --tilt-direction --surface --surface-depth --no-penetration --onto --scale --object-size --up --advancing --receding --triangles --edge --grading --open --material --unit --quads --format --nodes --droplets-only --materials --fill-range --sink --base --lod --weld --compress --colour-map --preview --view --camera --look-at --preview-size --ground --environment --preview-background --preview-colour --turntable --codec --quality --maps --map-width --map-thickness --map-tile --json --html --export-evolver --watch --no-clobber --solver --threads --quiet --verbose --progress --config --help --version' ;;
    esac
    [[ ' animate batch compare dew flow glyphs liquid2d morph studio wind-tunnel windshield ' == *" $command "* ]] || command=
    case $command:$previous in
        *:--width) return ;;
        *:--pixel-size) return ;;
        *:--channel) choices='auto alpha luma' ;;
        *:--threshold) return ;;
        *:--segment) choices='auto threshold adaptive grabcut' ;;
        *:--colour) return ;;
        *:--smooth) return ;;
        *:--fill-holes) return ;;
        *:--keep) return ;;
        *:--speck-size) return ;;
        *:--colours) choices='auto' ;;
        *:--gap) return ;;
        *:--seeds) files=1 ;;
        *:--mask-out) files=1 ;;
        *:--contact-angle) return ;;
        *:--on) choices='glass ptfe wax lotus' ;;
        *:--volume) return ;;
        *:--height) return ;;
        *:--fill) choices='each total' ;;
        *:--liquid) choices='water ethanol glycerol mercury honey' ;;
        *:--surface-tension) return ;;
        *:--density) return ;;
        *:--model) choices='auto linear exact' ;;
        *:--gravity) return ;;
        *:--tilt) return ;;
        *:--tilt-direction) return ;;
        *:--surface) files=1 ;;
        *:--surface-depth) return ;;
        *:--onto) files=1 ;;
        *:--scale) return ;;
        *:--object-size) return ;;
        *:--up) choices='y z' ;;
        *:--advancing) return ;;
        *:--receding) return ;;
        *:--triangles) return ;;
        *:--edge) return ;;
        *:--grading) choices='auto 1 2 4 8 16 32 64' ;;
        *:--material) choices='water ink mercury honey plain gel enamel glass resin oil milk lacquer blood gold frosted ice' ;;
        *:--unit) choices='m cm mm' ;;
        *:--format) choices='glb gltf obj ply stl usda usdz 3mf' ;;
        *:--nodes) choices='one each' ;;
        *:--materials) files=1 ;;
        *:--fill-range) return ;;
        *:--sink) return ;;
        *:--base) return ;;
        *:--lod) return ;;
        *:--compress) choices='none quantize meshopt' ;;
        *:--preview) files=1 ;;
        *:--view) choices='three-quarter top side' ;;
        *:--camera) return ;;
        *:--look-at) return ;;
        *:--preview-size) return ;;
        flow:--ground) return ;;
        *:--ground) files=1 ;;
        *:--environment) files=1 ;;
        *:--preview-background) choices='ground none' ;;
        *:--preview-colour) choices='look contours contact-angle' ;;
        *:--turntable) return ;;
        *:--codec) return ;;
        *:--quality) return ;;
        *:--maps) files=1 ;;
        *:--map-width) return ;;
        *:--map-thickness) return ;;
        *:--json) files=1 ;;
        *:--html) files=1 ;;
        *:--export-evolver) files=1 ;;
        liquid2d:--solver) choices='grid dfsph' ;;
        *:--solver) choices='auto llt multigrid' ;;
        *:-j) return ;;
        *:--threads) return ;;
        *:--progress) choices='auto none json' ;;
        *:--config) files=1 ;;
        *:--volume-mode) choices='total track fill' ;;
        *:--fps) return ;;
        *:--contact-sheet) files=1 ;;
        *:--reveal) choices='left right top bottom middle' ;;
        *:--drips) return ;;
        *:--seed) return ;;
        *:--feed) return ;;
        *:--slow) return ;;
        *:--frames) return ;;
        *:-o) files=1 ;;
        *:--output) files=1 ;;
        *:--shard) return ;;
        *:--manifest) files=1 ;;
        *:--tolerance) return ;;
        *:--volume-tolerance) return ;;
        *:--normal-tolerance) return ;;
        *:--picture) files=1 ;;
        flow:--preset) choices='masses viscosities adhesions roughnesses tear forces bottle leaf car window' ;;
        wind-tunnel:--preset) choices='hashimoto thesis thesis,hashimoto' ;;
        windshield:--preset) choices='figure-3.10 figure-3.11 figure-3.12' ;;
        *:--preset) choices='dew rain bottle shower mist' ;;
        *:--coverage) return ;;
        *:--smallest) return ;;
        *:--largest) return ;;
        *:--sizes) choices='condensation lognormal' ;;
        *:--median) return ;;
        *:--spread) return ;;
        *:--from) return ;;
        *:--mask) files=1 ;;
        *:--hysteresis) return ;;
        *:--pinning) return ;;
        *:--pinning-length) return ;;
        *:--gravity-direction) return ;;
        *:--viscosity-factor) choices='artistic wedge' ;;
        *:--kinetic-fraction) return ;;
        *:--drag-coefficient) return ;;
        *:--boundary-layer) return ;;
        *:--profile-exponent) return ;;
        *:--air-density) return ;;
        *:--detail) choices='low medium high' ;;
        *:--instancing) choices='auto none nodes gpu' ;;
        *:--droplets) files=1 ;;
        *:--floor) choices='plate dish' ;;
        *:--spin) return ;;
        *:--spin-axis) return ;;
        *:--motion) files=1 ;;
        *:--object-animation) return ;;
        *:--drops) return ;;
        *:--radius) return ;;
        *:--volume-spread) return ;;
        *:--start) files=1 ;;
        *:--emitter) return ;;
        *:--rain) return ;;
        *:--condensation) return ;;
        *:--dew-spacing) return ;;
        *:--retention) choices='capillary paper' ;;
        *:--friction) return ;;
        *:--roughness) return ;;
        *:--roughness-map) files=1 ;;
        *:--friction-map) files=1 ;;
        *:--adhesion) return ;;
        *:--wind-velocity) return ;;
        *:--film) return ;;
        *:--bead-spacing) return ;;
        *:--drying) return ;;
        *:--time) return ;;
        windshield:--shape) choices='capillary capsule' ;;
        *:--shape) choices='capillary springs capsule' ;;
        *:--deformation) return ;;
        *:--streaks) files=1 ;;
        *:--map-age) return ;;
        *:--font) files=1 ;;
        *:--face-index) return ;;
        *:--axis) return ;;
        *:--text) return ;;
        *:--charset) return ;;
        *:--em) return ;;
        *:--align) choices='start centre end' ;;
        *:--line-sizes) return ;;
        *:--line-spacing) return ;;
        *:--tracking) return ;;
        *:--line-width) return ;;
        *:--arc) return ;;
        *:--path) files=1 ;;
        *:--path-width) return ;;
        *:--shift) return ;;
        *:--palette) return ;;
        *:--text-colour) return ;;
        *:--scene) choices='splash wave dam pour' ;;
        *:--particle-count) return ;;
        *:--walls) files=1 ;;
        *:--particles) files=1 ;;
        *:--particle-scale) return ;;
        *:--plane) choices='xy xz yz zx zy yx' ;;
        *:--spacing) return ;;
        *:--begin) return ;;
        *:--loop) return ;;
        *:--hold) return ;;
        *:--style) choices='realistic cartoon wave paper' ;;
        *:--tail) return ;;
        *:--tail-slope) return ;;
        *:--max-tail) return ;;
        *:--claws) return ;;
        *:--air) return ;;
        *:--release) return ;;
        *:--max-air) return ;;
        *:--eraser-share) return ;;
        *:--smoothing) return ;;
        *:--fairing) return ;;
        *:--resolution) return ;;
        *:--frame-width) return ;;
        *:--look) choices='flat comic ink night' ;;
        *:--least-droplet) return ;;
        *:--masks) files=1 ;;
        *:--particle-cache) files=1 ;;
        *:--font-family) return ;;
        *:--rounding) return ;;
        *:--mask-width) return ;;
        *:--wind-speed) return ;;
        *:--slope) return ;;
        *:--sliding-angle) return ;;
        *:--sliding-volume) choices='every' ;;
        *:--chart) files=1 ;;
        *:--map) files=1 ;;
        *:--measured) return ;;
        *:--trace) files=1 ;;
        *:--trace-step) return ;;
        *:--initial-speed) return ;;
        *:--gust) return ;;
        *:--gust-period) return ;;
        *:--mist) return ;;
        *:--speed) return ;;
        *:--drive-cycle) files=1 ;;
        *:--wind-model) choices='turned projected' ;;
        *:--noise) return ;;
        *:--wiper-period) return ;;
        *:--glass-width) return ;;
        *:--glass-height) return ;;
        *:--glass-radius) return ;;
        *:--still-diameter) return ;;
        *:--runoff) return ;;
        *:--warm-up) return ;;
        *:--background) files=1 ;;
        *:--background-blur) return ;;
        *:--frame-size) return ;;
        *:--field-of-view) return ;;
        *:--eye-distance) return ;;
        *:--eye) return ;;
        *:--samples) return ;;
        *:--exposure) return ;;
        *:--highlight-boost) return ;;
        *:--shutter) return ;;
        *:--animation) files=1 ;;
        *:--animation-method) choices='nodes texture' ;;
        *:--live) files=1 ;;
    esac
    if [[ -n $choices ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
    elif [[ -z $files && $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        if ((COMP_CWORD == 1)); then
            mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W 'animate batch compare dew flow glyphs liquid2d morph studio wind-tunnel windshield' -- "$word")
        fi
    fi
}
complete -o filenames -F _droplet_shape droplet-shape
