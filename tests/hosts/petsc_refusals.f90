! usage: petsc_refusals MESH.su2, on two or more processes: what one process has wrong in Fortran is refused by all, and
! none waits for ever.
program petsc_refusals
    use harmorph
    use harmorph_petsc
    use partitioned_flow
    implicit none
    type(hm_mesh) :: mesh
    type(hm_petsc) :: system, never
    type(hm_basis) :: basis, empty
    type(hm_error) :: err
    type(hm_step_report) :: limit
    type(hm_quality_report) :: quality
    real(dp), allocatable :: dx(:), dy(:)
    integer :: stat, passed = 0, failed = 0, counts(2), is_last
    character(len=256) :: file

    call MPI_Init()
    call MPI_Comm_rank(MPI_COMM_WORLD, rank)
    call MPI_Comm_size(MPI_COMM_WORLD, n_processes)
    call get_command_argument(1, file)
    call read_part(trim(file))
    is_last = merge(1, 0, rank == n_processes - 1)
    call hm_petsc_initialise()
    call mesh%points(x, y)
    call mesh%cells(tri)
    call mesh%faces(faces, marks)
    call never%solve(basis, stat=stat, err=err)
    call check_refused("a system that was never created")

    call system%create(mesh, numbers(:np - is_last), conditions=[hm_condition(airfoil, hm_rigid)], &
        comm=MPI_COMM_WORLD, stat=stat, err=err)
    call check_refused("a global number less than points")
    call system%solve(basis, stat=stat, err=err)
    call check_refused("a system whose creation was refused")
    call system%create(mesh, numbers, conditions=[hm_condition(airfoil + 6 * is_last, hm_rigid)], comm=MPI_COMM_WORLD, &
        stat=stat, err=err)
    call check_refused("a marker that is on no face")

    call system%create(mesh, numbers, conditions=[hm_condition(airfoil, hm_rigid)], comm=MPI_COMM_WORLD)
    call system%solve(basis)
    allocate(dx(np), dy(np))
    dx = 0
    dy = 0
    call system%displace(dx(:np - is_last), dy, stat=stat, err=err)
    call check_refused("displacements of fewer points")
    call system%assess(basis, dx(:np - is_last), dy, limit, quality, stat=stat, err=err)
    call check_refused("an assessment of fewer points")
    if (is_last == 1) then
        call system%assess(empty, dx, dy, limit, quality, stat=stat, err=err)
    else
        call system%assess(basis, dx, dy, limit, quality, stat=stat, err=err)
    end if
    call check_refused("an assessment without a basis")
    call system%assess(basis, dx, dy, limit, quality, stat=stat)
    call check(stat == 0 .and. quality%inverted == 0, "the same with right arguments")
    call system%free()
    call hm_petsc_finalise()
    call MPI_Reduce([passed, failed], counts, 2, MPI_INTEGER, MPI_SUM, 0, MPI_COMM_WORLD)
    if (rank == 0) print "(i0, a, i0, a)", counts(1), " passed, ", counts(2), " failed"
    call MPI_Finalize()
    if (failed > 0) error stop

contains

    subroutine check(holds, what)
        logical, intent(in) :: holds
        character(len=*), intent(in) :: what
        if (holds) then
            passed = passed + 1
        else
            failed = failed + 1
            print "(a, i0, 2a)", "petsc_refusals.f90, process ", rank, ": ", what
        end if
    end subroutine

    ! stat and err of all processes.
    subroutine check_refused(what)
        character(len=*), intent(in) :: what
        integer :: most
        call MPI_Allreduce(stat, most, 1, MPI_INTEGER, MPI_MAX, MPI_COMM_WORLD)
        call check(most < 0, what // ": refused by all")
        call check(len_trim(err%text) > 0, what // ": with a reason")
    end subroutine
end program
