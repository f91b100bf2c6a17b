! Inverse design on several processes (see inverse.f90): which airfoil has this pressure? Each process has its own
! cells, and no process has the whole mesh. Lines with !hm touch harmorph, which solves with PETSc.
!
!     mpirun -np 4 ./partitioned naca0012.su2
program partitioned
    use harmorph                                                                        !hm
    use harmorph_mpi, only: hm_mpi_adjoint                                              !hm
    use harmorph_petsc                                                                  !hm
    use bfgs
    use partitioned_flow
    implicit none
    integer, parameter :: n = 14, n_outline = 200, most = 40
    type(hm_mesh) :: mesh                                                               !hm
    type(hm_curves) :: curves                                                           !hm
    type(hm_petsc) :: system                                                            !hm
    type(hm_basis) :: basis                                                             !hm
    type(hm_petsc_report) :: report                                                     !hm
    type(hm_step_report) :: limit                                                       !hm
    type(hm_quality_report) :: quality                                                  !hm
    real(dp) :: outline(2, n_outline), t, thickness
    real(dp), dimension(2, n) :: move, goal, slope, old_slope, direction, change
    real(dp) :: h(2 * n, 2 * n), j, old_j, error(0:most), step
    real(dp), allocatable :: x_start(:), y_start(:), dx(:), dy(:), gx(:), gy(:)
    integer :: k, tries
    character(len=256) :: file

    call MPI_Init()
    call MPI_Comm_rank(MPI_COMM_WORLD, rank)
    call MPI_Comm_size(MPI_COMM_WORLD, n_processes)
    call get_command_argument(1, file)
    call read_part(trim(file))
    allocate(dx(np), dy(np), gx(np), gy(np))
    x_start = x
    y_start = y
    do k = 1, n_outline                         ! NACA 0012 with a sharp trailing edge, on all processes
        t = 0.5_dp + 0.5_dp * cos(6.283185307179586_dp * (k - 1) / n_outline)
        thickness = t * (-0.126_dp + t * (-0.3516_dp + t * (0.2843_dp - t * 0.1036_dp)))
        thickness = 0.6_dp * (0.2969_dp * sqrt(t) + thickness)
        outline(:, k) = [t, merge(thickness, -thickness, 2 * (k - 1) < n_outline)]
    end do

    ! Done once: the solver's part of the mesh, a curve through the airfoil, and the harmonic functions.
    call hm_petsc_initialise()                                                          !hm
    call mesh%points(x, y)                                                              !hm
    call mesh%cells(tri)                                                                !hm
    call mesh%faces(faces, marks)                                                       !hm
    call curves%fit(outline(1, :), outline(2, :), loop=.true., n_control=n)             !hm
    call system%create(mesh, numbers, curves, [hm_condition(airfoil)], MPI_COMM_WORLD)  !hm
    call system%solve(basis, report)                                                    !hm
    if (rank == 0) print "(i0, a, i0, a)", report%unknowns, " unknowns on ", n_processes, " processes"      !hm

    ! The target is an airfoil with more camber and less thickness; the loop below uses only its pressure.
    goal = 0
    goal(2, :) = 0.08_dp * curves%control(1, :) * (1 - curves%control(1, :)) - 0.15_dp * curves%control(2, :)   !hm
    call go_to(goal)
    call solve_flow()
    cp_target = cp
    move = 0
    call go_to(move)
    call evaluate()
    call check_slope()

    ! BFGS on the heights of the control points; the first one, the trailing edge, stays.
    h = scaled_identity(reshape(slope, [2 * n]), longest=0.01_dp)
    do k = 0, most
        error(k) = sqrt(j)
        if (error(k) < 0.05_dp * error(0) .or. k == most) exit
        direction = -reshape(matmul(h, reshape(slope, [2 * n])), [2, n])
        call basis%displacement(move + direction, dx, dy)                               !hm
        call system%assess(basis, dx, dy, limit, quality)                               !hm
        step = min(1._dp, 0.5_dp * limit%admissible)                                    !hm
        old_j = j
        old_slope = slope
        do tries = 1, 20
            change = step * direction
            call go_to(move + change)
            call evaluate()
            if (j < old_j + 1e-4_dp * sum(change * old_slope)) exit
            step = 0.5_dp * step
        end do
        move = move + change
        call update(h, reshape(change, [2 * n]), reshape(slope - old_slope, [2 * n]))
    end do
    call basis%displacement(move, dx, dy)                                               !hm
    call system%assess(basis, dx, dy, limit, quality)                                   !hm
    call system%free()                                                                  !hm
    if (rank == 0) print "(a, f0.0, a, i0, a, i0, a)", "pressure error: divided by ", error(0) / error(k), " in ", k, &
        " steps; ", quality%inverted, " inverted cells"                                 !hm
    if (error(k) > 0.05_dp * error(0)) error stop "The pressure error was not divided by 20."
    if (quality%inverted > 0) error stop "The mesh has inverted cells."              !hm
    call hm_petsc_finalise()                                                            !hm
    call MPI_Finalize()

contains

    ! Makes the mesh for these movements of the control points, always from the start, so that no errors accumulate.
    subroutine go_to(at)
        real(dp), intent(in) :: at(2, n)
        call basis%morph_to(at, x_start, y_start, x, y)                                 !hm
    end subroutine

    ! Computes the objective and the slope dJ/dP on the present mesh.
    subroutine evaluate()
        call solve_flow()
        j = objective()
        call gradient(gx, gy)
        call hm_mpi_adjoint(basis, gx, gy, slope, MPI_COMM_WORLD)                       !hm
        slope(1, :) = 0
        slope(2, 1) = 0
    end subroutine

    ! Compares the gradient with central differences along the steepest descent.
    subroutine check_slope()
        real(dp), parameter :: eps = 1e-5_dp
        real(dp) :: by_differences, by_adjoint
        direction = slope / norm2(slope)
        by_adjoint = sum(slope * direction)
        call go_to(eps * direction)
        call solve_flow()
        by_differences = objective()
        call go_to(-eps * direction)
        call solve_flow()
        by_differences = (by_differences - objective()) / (2 * eps)
        if (rank == 0) print "(a, 2es20.12)", "slope, by the adjoint and by differences: ", by_adjoint, by_differences
        if (abs(by_adjoint - by_differences) > 1e-6_dp * abs(by_adjoint)) &
            error stop "The gradient differs from central differences."
        call go_to(move)
    end subroutine
end program
