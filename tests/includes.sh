#!/bin/sh
# Includes point only downwards. The rooms of the core, bottom to top, one per line: a header may include what is in a
# lower room, or in its own room further to the left; a source may include all of its own room as well.
rooms='
types
span scalar arena progress processor executor cell_ranges
vec2 predicates angle value_kind sort hash monotone kernel_call fixed_sum
product product_kernel product_baseline product_avx2 product_avx512 rows flush
dense dense_tiles dense_sums dense_kernel dense_moves dense_baseline dense_avx2 dense_avx512 envelope mesh cell_shape bspline
box_tree locate
corners closure knots least_squares projection chain fit
translations edges median_dual nodal_gradient nodal_balance orientation boundary delaunay distortion region conditions method distance distance_tree distance_kernel distance_baseline distance_avx2 distance_avx512 first_layer wall_heights wall slip periodic
graph layers border_cover places cut_search dissection dissector fronts subtrees
symmetric_rows block_rows agglomeration
matrix matrix_cells stiffness bounded basis basis_check single extract parcel residual residual_kernel residual_baseline residual_avx2 residual_avx512 nodal_equations right_hand_sides path
multifrontal multifrontal_factor multifrontal_solve biconjugate_gradients iteration block_iteration multigrid multigrid_cycle control_volumes runge_kutta full_approximation approximation_cycle analysis newton_system untangle harmonic harmonic_assembly harmonic_refinement
morph adjoint weighted_sum quality admissible_step assessment crossing transfer
safe_morph
'
# Of the standard library the core may use what a freestanding compiler has, and mem*.
freestanding='cstddef|cstdint|cfloat|climits|limits|type_traits|new|cstring|immintrin\.h|arm_neon\.h|cpuid\.h'

passed=0 failed=0
verdict() {   # file, offenders
    if [ -z "$2" ]; then passed=$((passed + 1)); return; fi
    failed=$((failed + 1))
    echo "includes: $1:" $2
}
included() { sed -n 's|^ *# *include *[<"]\([^>"]*\)[>"].*|\1|p' "$1"; }
place() {   # 100 * room + position from the left; nothing if in no room
    echo "$rooms" | awk -v name="$1" 'NF { ++room; for (k = 1; k <= NF; ++k) if ($k == name) print 100 * room + k }'
}

for file in include/harmorph/*.hpp src/*.hpp src/*.cpp; do
    here=$(place "$(basename "$file" | sed 's/\.[ch]pp$//')")
    if [ -z "$here" ]; then verdict "$file" "is in no room of tests/includes.sh"; continue; fi
    case $file in *.cpp) limit=$((here / 100 * 100 + 100)) ;; *) limit=$here ;; esac
    wrong=
    for name in $(included "$file"); do
        case $name in
        *.hpp)
            there=$(place "$(basename "$name" .hpp)")
            if [ -z "$there" ] || [ "$there" -ge "$limit" ]; then wrong="$wrong $name"; fi ;;
        *) if ! echo "$name" | grep -qxE "$freestanding"; then wrong="$wrong $name"; fi ;;
        esac
    done
    verdict "$file" "$wrong"
done

# The program is a client of the C header alone.
for file in c_api/cli/*; do
    verdict "$file" "$(included "$file" | grep -E '/' | grep -vE '^sys/')"
done
echo "$passed passed, $failed failed"
[ $failed = 0 ]
