# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of droplet-shape for bash.

_droplet_shape()
{
    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
    # bash takes the '=' of --option=value for a word of its own.
    if [[ $word == = ]]; then
        word=
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD-2]}
    fi

    local choices=
    case $previous in
        --channel) choices='auto alpha luma' ;;
        --fill) choices='each total' ;;
        --model) choices='linear exact' ;;
        --liquid) choices='water ethanol glycerol mercury honey' ;;
        --material) choices='water ink mercury honey plain' ;;
        --background)
            if [[ ${COMP_WORDS[1]} != windshield ]]; then
                choices='ground none'
            fi
            ;;
        --unit) choices='m cm mm' ;;
        --format) choices='glb gltf obj ply stl' ;;
        --grading) choices='1 2 4 8 16 32 64' ;;
        --volume-mode) choices='total track' ;;
        --solver) choices='auto llt multigrid' ;;
        --view) choices='three-quarter top side' ;;
        --segment) choices='auto threshold adaptive grabcut' ;;
        --preview-colour) choices='look contours contact-angle' ;;
        --colour)
            choices='black white red green blue yellow'
            if [[ ${COMP_WORDS[1]} == glyphs ]]; then
                choices='look contours contact-angle'
            fi
            ;;
        --align) choices='start centre end' ;;
        --progress) choices='auto none json' ;;
        --preset)
            choices='hashimoto thesis thesis,hashimoto'
            if [[ ${COMP_WORDS[1]} == windshield ]]; then
                choices='figure-3.10 figure-3.11 figure-3.12'
            fi
            ;;
        --viscosity-factor) choices='artistic wedge' ;;
        --wind)
            if [[ ${COMP_WORDS[1]} != windshield ]]; then
                COMPREPLY=()
                return
            fi
            choices='turned projected'
            ;;
        --width | --pixel-size | --threshold | --speck-size | --smooth | --fill-holes | --keep | --contact-angle | --volume | --height | \
            --surface-tension | --density | --gravity | --tilt | --tilt-direction | --surface-depth | \
            --tolerance | --volume-tolerance | --normal-tolerance | --advancing | --receding | --triangles | --edge | \
            --fill-range | --fps | --preview-size | --camera | --face-index | --axis | --text | --charset | --em | \
            --line-spacing | --shard | --turntable | --slope | --hysteresis | --falling-angle | \
            --falling-volume | --kinetic-fraction | --drag-coefficient | --boundary-layer | --profile-exponent | \
            --air-density | --measured | --time | --trace-step | --initial-speed | --gust | --gust-period | \
            --rain | --speed | --noise | --wiper | --seed | --glass-width | --glass-height | --radius | \
            --still-diameter | --film | --warm-up | --size | --field-of-view | --eye-distance | --samples | \
            --codec | --map-width | --exposure | --highlight-boost | --background-blur | --shutter | --quality | --eye | --look-at | \
            --threads | -j)
            COMPREPLY=()
            return
            ;;
        --surface | --onto | --font | --output | -o | --manifest | --contact-sheet | --preview | --ground | --mask-out | --environment | \
            --picture | --chart | --map | --trace | --drive-cycle | --maps | \
            --droplets | --model | --json | --html | --export-evolver | --config) ;;
        *)
            if [[ $word == -* ]]; then
                local making='--contact-angle --volume --height --fill
                    --liquid --surface-tension --density --model
                    --gravity --tilt --tilt-direction --surface --surface-depth --no-penetration --onto
                    --advancing --receding --triangles --edge --grading --open --material --unit'
                local running='--no-clobber --solver --threads --quiet --verbose --progress --config --help --version'
                local showing='--preview --view --camera --preview-size --ground --environment --background --preview-colour
                    --turntable'
                local picture='--width --pixel-size --channel --threshold --invert --speck-size --segment --colour
                    --smooth --fill-holes --keep'
                case ${COMP_WORDS[1]} in
                    animate) choices="$picture $making $running --volume-mode --fps --contact-sheet --preview
                        --view --camera --preview-size --html --json" ;;
                    batch)
                        choices="$picture $making $running --format --fill-range --json
                            --output --recursive --keep-going --no-resume --shard --manifest --contact-sheet --one-scale"
                        ;;
                    glyphs) choices="$making $running $showing --colour --format --fill-range --json --html --font --face-index
                        --axis --text --charset --all --list --output --em --tolerance --align --line-spacing
                        --equal-height --keep-going --no-resume --shard --manifest --contact-sheet --one-scale" ;;
                    compare) choices='--tolerance --volume-tolerance --normal-tolerance --picture --json --no-clobber
                        --threads --quiet --config --help --version' ;;
                    wind-tunnel) choices='--preset --volume --wind --slope --hysteresis --falling-angle
                        --falling-volume --contact-angle --viscosity-factor --kinetic-fraction --drag-coefficient
                        --boundary-layer --profile-exponent --air-density --liquid --surface-tension --density
                        --gravity --chart --map --measured --trace --time --trace-step --initial-speed --gust
                        --gust-period --json --no-clobber --threads --quiet --config --help --version' ;;
                    windshield) choices='--preset --rain --speed --drive-cycle --wind --noise --wiper --seed --glass-width
                        --glass-height --radius --slope --surface --hysteresis --still-diameter --film
                        --contact-angle --viscosity-factor --kinetic-fraction --drag-coefficient
                        --boundary-layer --profile-exponent --air-density --liquid --surface-tension --density
                        --gravity --time --warm-up --fps --background --environment --fit --background-blur --size --field-of-view
                        --eye-distance --eye --look-at --samples --exposure --highlight-boost --shutter --layer --codec --quality --maps --map-width --droplets --moving-only --model --json
                        --resume --no-clobber --threads --quiet --config --help --version' ;;
                    *) choices="$picture --mask-out $making $running $showing --format --fill-range --json --html --export-evolver" ;;
                esac
            fi
            ;;
    esac
    if [[ -n $choices ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
    if ((COMP_CWORD == 1)); then
        local commands='animate batch compare glyphs wind-tunnel windshield'
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$commands" -- "$word")
    fi
}
complete -o filenames -F _droplet_shape droplet-shape
