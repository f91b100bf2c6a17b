! Every procedure of the Fortran module, with assertions: one file for each topic. With an argument: does what must stop
! the program (see fortran.sh).
program use
    use body_mesh
    use kept, only: make_kept
    use assessment_tests
    use blocks_tests
    use boundaries_tests
    use bounds_tests
    use cells_tests
    use conditions_tests
    use coordinates_tests
    use curves_tests
    use design_tests
    use edges_tests
    use fields_tests
    use given_tests
    use kinds_tests
    use memory_tests
    use morph_tests
    use operators_tests
    use plan_tests
    use plane_tests
    use polygons_tests
    use refusals_tests
    use safe_tests
    use sequences_tests
    use slip_tests
    use storage_tests
    use structured_tests
    use threads_tests
    use transfer_tests
    implicit none
    character(len=32) :: mode

    call make_body_mesh()
    call make_kept()
    call get_command_argument(1, mode)
    if (mode /= "") then
        call stop_by(trim(mode))
        print "(a)", "went on"
        stop
    end if

    call versions()
    call curves_by_hand()
    call fits()
    call fits_of_walls()
    call analysis_alone()
    call solution()
    call rational_curves()
    call other_coordinates()
    call pieces()
    call given_parameters()
    call fluxes()
    call morphs()
    call layouts()
    call structured_block()
    call several_blocks()
    call polygons()
    call default_reals()
    call long_integers()
    call derived_types()
    call addresses()
    call pointers()
    call sections()
    call not_doubles()
    call integers_of_any_kind()
    call cells_of_two_kinds()
    call boundary_in_pieces()
    call types_of_points()
    call meshes_of_edges()
    call files()
    call single_precision()
    call own_memory()
    call working_memory()
    call shared_with_plans()
    call threads()
    call operators()
    call conditions()
    call assessments()
    call smooth_bounds()
    call safe_strategies()
    call safe_heights()
    call safe_steps()
    call slip_on_a_circle()
    call given_displacements()
    call safe_together()
    call transfers()
    call fields()
    call design()
    call refits()
    call smooth_gradients()
    call moved_sections()
    call tables()
    call planes()
    call numbers_in_errors()
    call refusals()
    call shared_points()
    call sequences()
    call tell_counts()

contains

    subroutine versions()
        call check(hm_abi_version() == hm_abi, "module and library fit")
        call check(hm_version() == hm_header_version, "version")
        call check(hm_status_name(hm_moved) == "HM_MOVED", "name of a status")
        call check(hm_status_name(99) == "unknown status", "name of an unknown status")
    end subroutine

    ! These calls must stop the program with the reason.
    subroutine stop_by(what)
        character(len=*), intent(in) :: what
        type(hm_mesh) :: another_mesh
        type(hm_plan) :: plan, another_plan
        type(hm_basis) :: another_basis
        type(hm_curves) :: curves
        type(hm_options) :: options
        type(hm_error) :: err
        real(dp) :: x_new(n_points), y_new(n_points)
        options%operator_kind = hm_laplace
        call basis%curves(curves)
        select case (what)
        case ("one_iteration")
            options%engine = hm_multigrid
            options%max_iterations = 1
            call solve(mesh, another_basis, options=options)
        case ("part_of_the_way")
            call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
            call plan%factor()
            call plan%solve(another_basis)
            call plan%morph_safe(another_basis, turn(curves%control, 40._dp), x_new, y_new, &
                options=hm_safe_options(max_resolves=-1, skipped_strategies=2**hm_strategy_untangled))
        case ("save_nothing")
            call another_basis%save("nothing", err=err)
        case ("one_array_twice")
            call one_array_twice()
        case ("assign_mesh")
            another_mesh = mesh
        case ("assign_plan")
            another_plan = plan
        case ("assign_basis")
            another_basis = basis
        end select
    end subroutine
end program
