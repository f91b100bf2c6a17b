/* The C side of layout.f90: size and places of all fields of each struct, and the values of the
 * constants. */
#include <harmorph.h>

int32_t layout_of(int32_t number, int64_t* numbers);

#define PUT(value) numbers[n++] = (int64_t)(value)
#define AT(field) PUT(offsetof(TYPE, field))

int32_t layout_of(int32_t number, int64_t* numbers) {
    int32_t n = 0;
    switch (number) {
#define TYPE hm_error
        case 1:
            PUT(sizeof(TYPE));
            AT(code);
            AT(item_kind);
            AT(item);
            AT(item_base);
            AT(other_kind);
            AT(other);
            AT(other_base);
            AT(reserved);
            AT(value);
            AT(x);
            AT(y);
            AT(text);
            break;
#undef TYPE
#define TYPE hm_executor
        case 2:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(run);
            AT(user);
            AT(n_threads);
            AT(kernel);
            break;
#undef TYPE
#define TYPE hm_mesh
        case 3:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(index_base);
            AT(n_points);
            AT(points);
            AT(cell_layout);
            AT(n_cells);
            AT(cell_start);
            AT(cell_points);
            AT(ni);
            AT(nj);
            AT(n_faces);
            AT(face_points);
            AT(face_markers);
            AT(n_lists);
            AT(list_start);
            AT(list_points);
            AT(list_markers);
            AT(n_quads);
            AT(quad_points);
            AT(n_blocks);
            AT(reserved);
            AT(block_sizes);
            AT(block_markers);
            break;
#undef TYPE
#define TYPE hm_curve
        case 4:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(degree);
            AT(n_indices);
            AT(indices);
            AT(knots);
            break;
#undef TYPE
#define TYPE hm_curves
        case 5:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(index_base);
            AT(n_control);
            AT(control);
            AT(weights);
            AT(n_curves);
            AT(curve);
            break;
#undef TYPE
#define TYPE hm_fit_options
        case 6:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(degree);
            AT(n_control);
            AT(closed);
            AT(index_base);
            break;
#undef TYPE
#define TYPE hm_fit_report
        case 7:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(max_error);
            AT(rms_error);
            AT(max_error_point);
            AT(closed);
            AT(first_point);
            AT(base_points);
            AT(reason);
            AT(corners);
            AT(backtrack_point);
            AT(reserved);
            break;
#undef TYPE
#define TYPE hm_condition
        case 8:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(marker);
            AT(kind);
            AT(first_curve);
            AT(n_curves);
            AT(body);
            AT(partner);
            AT(x);
            AT(y);
            AT(piece);
            AT(reserved);
            AT(near_x);
            AT(near_y);
            AT(along);
            break;
#undef TYPE
#define TYPE hm_problem
        case 9:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(mesh);
            AT(curves);
            AT(n_conditions);
            AT(conditions);
            AT(n_given);
            AT(given_points);
            AT(given_curves);
            AT(given_u);
            break;
#undef TYPE
#define TYPE hm_options
        case 10:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(operator_kind);
            AT(scheme);
            AT(engine);
            AT(kernel);
            AT(tolerance);
            AT(progress);
            AT(progress_user);
            AT(executor);
            AT(exponent_quarters);
            AT(offset_correction);
            AT(levels);
            AT(agglomeration);
            AT(block_width);
            AT(max_iterations);
            AT(history);
            AT(history_length);
            AT(precision);
            AT(start);
            AT(reserved);
            break;
#undef TYPE
#define TYPE hm_mesh_report
        case 11:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(points);
            AT(used_points);
            AT(cells);
            AT(triangles);
            AT(quads);
            AT(edges);
            AT(boundary_edges);
            AT(boundary_loops);
            AT(inverted);
            AT(first_inverted);
            AT(min_area);
            AT(min_quality);
            AT(mean_quality);
            AT(polygons);
            AT(reserved);
            break;
#undef TYPE
#define TYPE hm_solve_report
        case 12:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(unknowns);
            AT(functions);
            AT(residual);
            AT(residual_function);
            AT(boundary_error_point);
            AT(boundary_error);
            AT(partition_defect);
            AT(min_value);
            AT(max_value);
            AT(max_distance);
            AT(max_distance_point);
            AT(curve_points);
            AT(refinements);
            AT(reserved);
            AT(factor_entries);
            AT(iterations);
            AT(levels);
            AT(fine_sweeps);
            AT(reserved_too);
            break;
#undef TYPE
#define TYPE hm_basis_info
        case 13:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(bytes);
            AT(solved);
            AT(points);
            AT(cells);
            AT(functions);
            AT(curves);
            AT(curve_points);
            AT(numbers_per_value);
            AT(operator_kind);
            AT(scheme);
            AT(engine);
            AT(index_base);
            AT(curve_point);
            AT(point_curve);
            AT(point_u);
            AT(exponent_quarters);
            AT(bodies);
            AT(offset_correction);
            AT(storage);
            AT(combined);
            AT(control_points);
            AT(modes);
            AT(reserved);
            break;
#undef TYPE
#define TYPE hm_transfer_report
        case 14:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(points);
            AT(outside);
            AT(max_distance);
            AT(max_distance_point);
            AT(boundary_error_point);
            AT(boundary_error);
            AT(wall_correction);
            break;
#undef TYPE
#define TYPE hm_step_report
        case 15:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(admissible);
            AT(cell);
            AT(point);
            break;
#undef TYPE
#define TYPE hm_quality_report
        case 16:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(inverted);
            AT(first_inverted);
            AT(min_area);
            AT(min_quality);
            AT(mean_quality);
            AT(min_quality_cell);
            AT(self_crossing);
            AT(crossing_points);
            break;
#undef TYPE
#define TYPE hm_safe_options
        case 17:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(max_resolves);
            AT(skipped_strategies);
            AT(n_others);
            AT(reserved);
            AT(others);
            AT(heights);
            AT(reached);
            AT(min_quality);
            AT(max_height_change);
            break;
#undef TYPE
#define TYPE hm_safe_report
        case 18:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(strategy);
            AT(other);
            AT(steps);
            AT(resolves);
            AT(step_fraction);
            AT(admissible);
            AT(cell);
            AT(point);
            AT(untangled);
            AT(iterations);
            AT(crossing_points);
            AT(inverted);
            AT(min_quality_cell);
            AT(min_quality);
            AT(mean_quality);
            AT(mean_angle_change);
            AT(max_angle_change);
            AT(mean_height_ratio);
            AT(min_height_ratio);
            AT(max_height_ratio);
            AT(heights);
            AT(angle_point);
            AT(min_height_point);
            AT(max_height_point);
            AT(n_worst);
            AT(turned_offset);
            AT(start_quality);
            AT(worst);
            AT(worst[0].reserved);
            AT(worst[0].quality);
            AT(worst[0].start_quality);
            AT(worst[0].x);
            AT(worst[0].y);
            AT(worst[1]);
            break;
#undef TYPE
        case 19:
            PUT(HM_ABI);
            PUT(HM_OK);
            PUT(HM_NOT_CONVERGED);
            PUT(HM_MOVED);
            PUT(HM_SHORT);
            PUT(HM_BACKTRACKS);
            PUT(HM_FAR_FROM_CURVE);
            PUT(HM_POOR);
            PUT(HM_CANCELLED);
            PUT(HM_BAD_ARGUMENT);
            PUT(HM_BAD_MESH);
            PUT(HM_BAD_CURVE);
            PUT(HM_BAD_CONDITION);
            PUT(HM_BAD_BASIS);
            PUT(HM_BLOCK_TOO_SMALL);
            PUT(HM_NOT_POSITIVE);
            PUT(HM_UNSUPPORTED);
            PUT(HM_CROSSING);
            PUT(HM_ITEM_NONE);
            PUT(HM_ITEM_POINT);
            PUT(HM_ITEM_CELL);
            PUT(HM_ITEM_SIDE);
            PUT(HM_ITEM_MARKER);
            PUT(HM_ITEM_CURVE);
            PUT(HM_ITEM_CONTROL_POINT);
            PUT(HM_ITEM_CONDITION);
            PUT(HM_ITEM_FUNCTION);
            PUT(HM_ITEM_BODY);
            PUT(HM_ITEM_LIST);
            PUT(HM_ITEM_BLOCK);
            PUT(HM_ITEM_KNOT);
            PUT(HM_ITEM_VARIABLE);
            PUT(HM_ITEM_QUANTITY);
            PUT(HM_ITEM_FIELD);
            PUT(HM_ITEM_ENTRY);
            PUT(HM_ITEM_GLOBAL_POINT);
            break;
        case 20:
            PUT(HM_CELLS_ROWS);
            PUT(HM_CELLS_TRIANGLES);
            PUT(HM_CELLS_QUADS);
            PUT(HM_CELLS_STRUCTURED);
            PUT(HM_CELLS_MIXED);
            PUT(HM_CELLS_BLOCKS);
            PUT(HM_CELLS_POLYGONS);
            PUT(HM_NO_MARKER);
            PUT(HM_SPACE_AUTO);
            PUT(HM_PLANES);
            PUT(HM_WEDGE);
            PUT(HM_CLOSED_AUTO);
            PUT(HM_OPEN);
            PUT(HM_TIED);
            PUT(HM_PERIODIC);
            PUT(HM_FIT_ASKED);
            PUT(HM_FIT_NO_LOOP);
            PUT(HM_FIT_NO_CORNER);
            PUT(HM_FIT_CORNER);
            PUT(HM_FIT_BASE);
            PUT(HM_ON_CURVE);
            PUT(HM_RIGID);
            PUT(HM_FIXED);
            PUT(HM_SLIP);
            PUT(HM_FREE);
            PUT(HM_PERIODIC_PAIR);
            PUT(HM_GIVEN);
            PUT(HM_ROTATION_PAIR);
            PUT(HM_CONFORMAL);
            PUT(HM_LAPLACE);
            PUT(HM_WEIGHTED);
            PUT(HM_NO_WEIGHT);
            PUT(HM_COMPACT);
            PUT(HM_NODAL_GRADIENT);
            PUT(HM_BOUNDED);
            PUT(HM_NODAL_GRADIENT_PLAIN);
            PUT(HM_DIRECT);
            PUT(HM_MULTIGRID);
            PUT(HM_FAS);
            PUT(HM_AGGLOMERATE_AUTO);
            PUT(HM_AGGLOMERATE_ISOTROPIC);
            PUT(HM_AGGLOMERATE_DIRECTIONAL);
            PUT(HM_KERNEL_AUTO);
            PUT(HM_KERNEL_BASELINE);
            PUT(HM_KERNEL_AVX2);
            PUT(HM_KERNEL_AVX512);
            PUT(HM_KERNEL_NEON);
            PUT(HM_DOUBLE);
            PUT(HM_SINGLE);
            PUT(HM_START_COARSEST);
            PUT(HM_START_ZERO);
            PUT(HM_PHASE_STRUCTURE);
            PUT(HM_PHASE_ORDERING);
            PUT(HM_PHASE_SYMBOLIC);
            PUT(HM_PHASE_ASSEMBLY);
            PUT(HM_PHASE_FACTOR);
            PUT(HM_PHASE_SOLVE);
            PUT(HM_PHASE_RESIDUAL);
            PUT(HM_STRATEGY_LINEAR);
            PUT(HM_STRATEGY_OTHER);
            PUT(HM_STRATEGY_SUBSTEPS);
            PUT(HM_STRATEGY_UNTANGLED);
            PUT(HM_STRATEGY_IMPROVED);
            break;
#define TYPE hm_points
        case 21:
            PUT(sizeof(TYPE));
            AT(x);
            AT(y);
            AT(stride);
            break;
#undef TYPE
#define TYPE hm_points_out
        case 22:
            PUT(sizeof(TYPE));
            AT(x);
            AT(y);
            AT(stride);
            break;
#undef TYPE
#define TYPE hm_space_points
        case 23:
            PUT(sizeof(TYPE));
            AT(x);
            AT(y);
            AT(z);
            AT(stride);
            break;
#undef TYPE
#define TYPE hm_space_points_out
        case 24:
            PUT(sizeof(TYPE));
            AT(x);
            AT(y);
            AT(z);
            AT(stride);
            break;
#undef TYPE
#define TYPE hm_space_mesh
        case 25:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(index_base);
            AT(n_points);
            AT(points);
            AT(kind);
            AT(n_faces);
            AT(face_start);
            AT(face_points);
            AT(n_sides);
            AT(side_points);
            AT(side_markers);
            AT(axis_point);
            AT(axis);
            AT(tolerance);
            break;
#undef TYPE
#define TYPE hm_plane_info
        case 26:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(kind);
            AT(n_points);
            AT(n_space_points);
            AT(layers);
            AT(origin);
            AT(x_direction);
            AT(y_direction);
            AT(normal);
            AT(max_distance);
            AT(max_distance_point);
            AT(reserved);
            AT(follows);
            AT(space_point);
            break;
#undef TYPE
#define TYPE hm_improve_options
        case 101:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(max_iterations);
            AT(reserved);
            AT(reference);
            break;
#undef TYPE
#define TYPE hm_improve_report
        case 102:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(iterations);
            AT(movable);
            AT(min_quality_before);
            AT(mean_quality_before);
            AT(min_quality);
            AT(mean_quality);
            AT(min_quality_cell_before);
            AT(min_quality_cell);
            break;
#undef TYPE
#define TYPE hm_section
        case 27:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(first_curve);
            AT(n_curves);
            AT(nose_x);
            AT(nose_y);
            AT(edge_x);
            AT(edge_y);
            break;
#undef TYPE
#define TYPE hm_quantity
        case 28:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(kind);
            AT(n_polygon);
            AT(station);
            AT(polygon);
            break;
#undef TYPE
#define TYPE hm_variables
        case 29:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(kind);
            AT(n_upper);
            AT(n_lower);
            AT(degree_x);
            AT(degree_y);
            AT(x_min);
            AT(y_min);
            AT(x_max);
            AT(y_max);
            AT(peaks);
            AT(nose_exponent);
            AT(edge_exponent);
            AT(width);
            break;
#undef TYPE
        case 30:
            PUT(HM_AREA);
            PUT(HM_CENTROID_X);
            PUT(HM_CENTROID_Y);
            PUT(HM_MOMENT_XX);
            PUT(HM_MOMENT_YY);
            PUT(HM_MOMENT_XY);
            PUT(HM_CHORD);
            PUT(HM_THICKNESS);
            PUT(HM_CAMBER);
            PUT(HM_MAX_THICKNESS);
            PUT(HM_MAX_CAMBER);
            PUT(HM_NOSE_RADIUS);
            PUT(HM_EDGE_ANGLE);
            PUT(HM_EDGE_GAP);
            PUT(HM_MIN_RADIUS);
            PUT(HM_CURVATURE_VARIATION);
            PUT(HM_CLEARANCE);
            PUT(HM_FFD);
            PUT(HM_CST);
            PUT(HM_HICKS_HENNE);
            PUT(HM_NACA4);
            break;
#define TYPE hm_block_points
        case 31:
            PUT(sizeof(TYPE));
            AT(x);
            AT(y);
            AT(stride);
            AT(row);
            break;
#undef TYPE
#define TYPE hm_block_points_out
        case 32:
            PUT(sizeof(TYPE));
            AT(x);
            AT(y);
            AT(stride);
            AT(row);
            break;
#undef TYPE
        default: break;
    }
    return n;
}
