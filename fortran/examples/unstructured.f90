! Morphs an unstructured mesh from a file in SU2's format: triangles and quadrilaterals, and boundary faces with
! markers, in any order. curves%fit finds the order of the wall points and the trailing edge.
program unstructured
    use, intrinsic :: iso_fortran_env, only: dp => real64
    use harmorph
    use read_su2
    implicit none
    character(len=256) :: name
    type(su2_mesh), target :: file
    type(hm_mesh) :: mesh
    type(hm_curves) :: curves
    type(hm_plan) :: plan
    type(hm_basis) :: basis
    type(hm_fit_report) :: fit
    type(hm_step_report) :: step
    type(hm_quality_report) :: quality
    real(dp), allocatable :: dx(:), dy(:), move(:, :)
    integer :: airfoil

    name = "naca0012.su2"
    if (command_argument_count() > 0) call get_command_argument(1, name)
    call read_su2_mesh(trim(name), file)
    airfoil = su2_marker(file, "airfoil")
    call mesh%points(file%x, file%y)        ! the solver's own arrays, which are not copied
    call mesh%cells(file%cells, file%start)
    call mesh%faces(file%faces, file%markers)

    ! Cubic B-splines with 20 control points through the points of the marker; one harmonic function for each of them.
    call curves%fit(mesh, airfoil, report=fit)
    call plan%analyse(mesh, curves, [hm_condition(airfoil, n_curves=size(curves%curve))])
    call plan%factor()
    call plan%solve(basis)
    call plan%free()

    ! The section gets a camber of 5 % of the chord; leading and trailing edge stay.
    allocate(dx(size(file%x)), dy(size(file%x)), move(2, size(curves%control, 2)))
    move(1, :) = 0
    move(2, :) = 0.2_dp * curves%control(1, :) * (1 - curves%control(1, :))
    call basis%displacement(move, dx, dy)
    call basis%assess(mesh, dx, dy, step, quality)
    print "(a, i0, a, es8.1, a, i0, a, f0.1, a)", "unstructured: ", size(curves%curve), &
        " curve(s) fit the airfoil to", fit%max_error, ", ", quality%inverted, &
        " inverted cells; the mesh could follow ", step%admissible, " times as far"
    if (quality%inverted > 0) error stop "The movement would invert cells."
    call basis%morph(move, file%x, file%y)
end program
