/* The C side of layout.f90: size and places of all fields of each struct, and the values of the
 * constants. */
#include <harmorph.h>
#include <harmorph_design.h>
#include <harmorph_space.h>
#include <harmorph_study.h>

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
            AT(pieces);
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
            AT(engine);
            AT(precision);
            AT(kernel);
            AT(tolerance);
            AT(progress);
            AT(progress_user);
            AT(executor);
            AT(exponent_quarters);
            AT(offset_correction);
            AT(study);
            break;
#undef TYPE
#define TYPE hm_study_options
        case 110:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(scheme);
            AT(levels);
            AT(agglomeration);
            AT(block_width);
            AT(max_iterations);
            AT(history);
            AT(history_length);
            AT(start);
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
            AT(boundary);
            AT(boundary_points);
            AT(reserved);
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
            AT(improve);
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
            AT(end_point);
            AT(reserved);
            AT(end_leaves);
            break;
#undef TYPE
        case 20:  // all constants of harmorph.h: fortran.sh writes the list
#include "constants_c.inc"
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
#define TYPE hm_edge_mesh
        case 33:
            PUT(sizeof(TYPE));
            AT(struct_size);
            AT(index_base);
            AT(n_points);
            AT(points);
            AT(n_cells);
            AT(n_edges);
            AT(edge_points);
            AT(edge_cells);
            AT(edge_markers);
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
            AT(leading_x);
            AT(leading_y);
            AT(trailing_x);
            AT(trailing_y);
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
            AT(leading_exponent);
            AT(trailing_exponent);
            AT(width);
            break;
#undef TYPE
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
