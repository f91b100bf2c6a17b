! harmorph for Fortran codes with MPI and PETSc, on meshes that no process has as a whole: see harmorph_petsc.h. Compile
! after harmorph.f90, with mpifort; link harmorph_petsc.c and harmorph_mpi.c (compiled with mpicc and PETSc's flags),
! libharmorph.a and PETSc. PETSc is initialised by the code; hm_petsc_initialise does it where the code does not use
! PETSc.
!
!     call system%create(mesh, numbers, curves, [hm_condition(wall)], comm)    own cells; global numbers of the points
!     call system%solve(basis)                        the rows of this process's points
!     call basis%displacement(move, dx, dy)           no messages
!     call system%assess(basis, dx, dy, step, quality)                         of the whole mesh, the same everywhere
!     call basis%morph(move, x, y)
!     call system%owned(mine)                         mine(points): every point of the mesh is one process's
!     call hm_mpi_adjoint(basis, dj_dx, dj_dy, gradient, comm)                 harmorph_mpi.f90; dj 0 where not mine
!     call system%free()
!
! All calls with system are collective but owned. comm is a type(MPI_Comm). numbers counts from 1; a point of several
! processes has the same number on each.
module harmorph_petsc
    use, intrinsic :: iso_c_binding
    use mpi_f08, only: mpi_comm, mpi_comm_null
    use harmorph
    implicit none
    private
    public :: hm_petsc, hm_petsc_report, hm_petsc_initialise, hm_petsc_finalise

    type, bind(c) :: hm_petsc_report
        integer(c_int64_t), private :: struct_size = 0
        integer(c_int64_t) :: unknowns = 0
        integer(c_int32_t) :: functions = 0, iterations = 0, solutions = 0, boundary_edges = 0
        real(c_double) :: change = 0, error = 0
        integer(c_int64_t) :: bytes = 0
    end type

    type :: hm_petsc
        private
        type(c_ptr) :: handle = c_null_ptr
        type(hm_part) :: part
        integer(c_int32_t) :: n_points = 0
        type(mpi_comm) :: comm = mpi_comm_null      ! of create; stays when create is refused: see solve
    contains
        procedure :: create
        procedure :: solve
        procedure :: displace
        procedure :: assess
        procedure :: owned
        procedure :: free
    end type

    interface
        function c_create(system, part, problem, options, comm, err) result(status) bind(c, name="hm_petsc_create_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error
            implicit none
            type(c_ptr), intent(inout) :: system
            type(c_ptr), value, intent(in) :: part, problem, options
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        subroutine c_free(system) bind(c, name="hm_petsc_free")
            import :: c_ptr
            implicit none
            type(c_ptr), intent(inout) :: system
        end subroutine
        function c_rows_size(system, bytes, err) result(status) bind(c, name="hm_petsc_rows_size")
            import :: c_int32_t, c_ptr, c_size_t, hm_c_error
            implicit none
            type(c_ptr), value, intent(in) :: system
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_solve(system, rows, block, bytes, report, comm, err) result(status) bind(c, name="hm_petsc_solve_f")
            import :: c_int, c_int32_t, c_ptr, c_size_t, hm_c_error, hm_petsc_report
            implicit none
            type(c_ptr), value, intent(in) :: system, block
            type(c_ptr), intent(inout) :: rows
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_petsc_report), intent(inout) :: report
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_displace(system, displacement, report, comm, err) result(status) bind(c, name="hm_petsc_displace_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points, hm_petsc_report
            implicit none
            type(c_ptr), value, intent(in) :: system
            type(hm_c_points), intent(in) :: displacement
            type(hm_petsc_report), intent(inout) :: report
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_assess(system, rows, from, displacement, step, quality, rank, comm, err) result(status) &
            bind(c, name="hm_petsc_assess_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points, hm_step_report, hm_quality_report
            implicit none
            type(c_ptr), value, intent(in) :: system, rows, from, rank
            type(hm_c_points), intent(in) :: displacement
            type(hm_step_report), intent(inout) :: step
            type(hm_quality_report), intent(inout) :: quality
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_owned(system, owned, err) result(status) bind(c, name="hm_petsc_owned")
            import :: c_int8_t, c_int32_t, c_ptr, hm_c_error
            implicit none
            type(c_ptr), value, intent(in) :: system
            integer(c_int8_t), intent(inout) :: owned(*)
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        integer(c_int) function c_initialise() bind(c, name="PetscInitializeNoArguments")
            import :: c_int
        end function
        integer(c_int) function c_finalise() bind(c, name="PetscFinalize")
            import :: c_int
        end function
    end interface

contains
    ! For codes that do not use PETSc themselves; after MPI_Init. Options: the environment variable PETSC_OPTIONS.
    subroutine hm_petsc_initialise()
        if (c_initialise() /= 0) error stop "harmorph: PETSc cannot be initialised"
    end subroutine

    subroutine hm_petsc_finalise()
        if (c_finalise() /= 0) error stop "harmorph: PETSc cannot be finalised"
    end subroutine

    ! mesh: own cells, ghost cells where ghosts is true, faces of own cells. What is refused is refused by all.
    subroutine create(self, mesh, numbers, curves, conditions, comm, ghosts, options, stat, err)
        class(hm_petsc), intent(inout) :: self
        type(hm_mesh), intent(in) :: mesh
        integer(c_int64_t), intent(in) :: numbers(:)
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in) :: conditions(:)
        type(mpi_comm), intent(in) :: comm
        logical, intent(in), optional :: ghosts(:)
        type(hm_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer :: refused
        type(hm_error) :: reason
        call self%free()
        call self%part%set(mesh, numbers, curves, conditions, ghosts, options, refused, reason)
        self%n_points = size(numbers)
        self%comm = comm
        ! What is wrong here alone leaves no part, which all then refuse together.
        status = c_create(self%handle, self%part%mesh_address(), self%part%problem_address(), &
            self%part%options_address(), int(self%comm%mpi_val, c_int), e)
        if (status < 0) call self%part%free()
        if (refused < 0 .and. (present(stat) .or. present(err))) then
            if (present(stat)) stat = refused
            if (present(err)) err = reason
            return
        end if
        call hm_finish("system%create", status, e, stat, err)
    end subroutine

    subroutine solve(self, basis, report, stat, err)
        class(hm_petsc), intent(inout) :: self
        type(hm_basis), intent(inout) :: basis
        type(hm_petsc_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_petsc_report) :: found
        type(hm_c_error) :: e
        type(c_ptr) :: block, rows
        integer(c_size_t) :: bytes
        integer(c_int32_t) :: status
        integer :: has_room
        found%struct_size = c_sizeof(found)
        bytes = 0
        block = c_null_ptr
        if (c_rows_size(self%handle, bytes, e) >= 0) call basis%room(bytes, block, has_room)
        ! What is wrong here alone is refused by all processes together.
        status = c_solve(self%handle, rows, block, bytes, found, int(self%comm%mpi_val, c_int), e)
        if (status >= 0) then
            call basis%take(rows)
        else
            call basis%free()
        end if
        if (present(report)) report = found
        call hm_finish("system%solve", status, e, stat, err)
    end subroutine

    ! dx, dy(points): in, what is given at points of markers with hm_given; out, the displacements of all points.
    subroutine displace(self, dx, dy, report, stat, err)
        class(hm_petsc), intent(inout) :: self
        real(c_double), intent(inout), contiguous, target :: dx(:), dy(:)
        type(hm_petsc_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_petsc_report) :: found
        type(hm_c_error) :: e
        type(hm_c_points) :: field
        integer(c_int32_t) :: status
        found%struct_size = c_sizeof(found)
        if (size(dx) == self%n_points .and. size(dy) == self%n_points) &
            field = hm_c_points(c_loc(dx), c_loc(dy), 1_c_int64_t)
        status = c_displace(self%handle, field, found, int(self%comm%mpi_val, c_int), e)
        if (present(report)) report = found
        call hm_finish("system%displace", status, e, stat, err)
    end subroutine

    ! The admissible step along dx, dy, and the quality there, of the whole mesh.
    subroutine assess(self, basis, dx, dy, step, quality, stat, err)
        class(hm_petsc), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in), contiguous, target :: dx(:), dy(:)
        type(hm_step_report), intent(inout) :: step
        type(hm_quality_report), intent(inout) :: quality
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_c_points) :: field
        integer(c_int32_t) :: status
        step%struct_size = c_sizeof(step)
        quality%struct_size = c_sizeof(quality)
        if (size(dx) == self%n_points .and. size(dy) == self%n_points) &
            field = hm_c_points(c_loc(dx), c_loc(dy), 1_c_int64_t)
        status = c_assess(self%handle, basis%address(), c_null_ptr, field, step, quality, c_null_ptr, &
            int(self%comm%mpi_val, c_int), e)
        call hm_finish("system%assess", status, e, stat, err)
    end subroutine

    subroutine owned(self, mine, stat, err)
        class(hm_petsc), intent(in) :: self
        logical, intent(out) :: mine(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int8_t), allocatable :: is_mine(:)
        integer(c_int32_t) :: status
        allocate(is_mine(max(self%n_points, size(mine))))
        is_mine = 0
        status = c_owned(self%handle, is_mine, e)
        mine = is_mine(:size(mine)) /= 0
        call hm_finish("system%owned", status, e, stat, err)
    end subroutine

    ! The basis stays.
    subroutine free(self)
        class(hm_petsc), intent(inout) :: self
        call c_free(self%handle)
        self%handle = c_null_ptr
        call self%part%free()
        self%n_points = 0
    end subroutine
end module
