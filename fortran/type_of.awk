# The type in Fortran of a struct of the C headers, for declarations.awk and interfaces.awk. The struct hm_mesh becomes
# the type hm_c_mesh; only reports, which users of the module read as they are, keep their names. Structs for output, as
# hm_points_out, have the type of those for input, hm_c_points.
function type_of(struct, name) {
    name = struct
    sub(/_out$/, "", name)
    if (name !~ /_report$/ && name !~ /^hm_(worst_cell|bound_value|step_corner)$/) sub(/^hm_/, "hm_c_", name)
    return name
}
