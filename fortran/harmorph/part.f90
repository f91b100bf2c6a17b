
! ---- The part of a mesh that one process has, for solvers on several processes: see harmorph_petsc.f90 ---------------

    type, bind(c), public :: hm_c_part_mesh
        integer(c_int64_t) :: struct_size = 0
        type(c_ptr) :: mesh = c_null_ptr, numbers = c_null_ptr, ghosts = c_null_ptr
    end type

    type :: part_data                         ! what C points to, where it stays
        type(problem) :: asked
        integer(c_int64_t), pointer :: numbers(:) => null()
        integer(c_int8_t), pointer :: ghosts(:) => null()
        type(hm_c_part_mesh) :: c
    end type

    type, public :: hm_part
        type(part_data), pointer, private :: data => null()
    contains
        procedure :: set => part_set
        procedure :: mesh_address => part_mesh_address
        procedure :: problem_address => part_problem_address
        procedure :: options_address => part_options_address
        procedure :: free => part_free
    end type

contains
    ! The process's own cells (and ghost cells, where ghosts(cells) is true), points with global numbers(points) from 1,
    ! and the faces of its own cells; curves, conditions and options are the same on all processes.
    subroutine part_set(self, mesh, numbers, curves, conditions, ghosts, options, stat, err)
        class(hm_part), intent(inout) :: self
        type(hm_mesh), intent(in) :: mesh
        integer(c_int64_t), intent(in) :: numbers(:)
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        logical, intent(in), optional :: ghosts(:)
        type(hm_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call self%free()
        call done%check_version()
        allocate(self%data)
        call set_problem(self%data%asked, mesh, curves, conditions, options=options, done=done)
        allocate(self%data%numbers(size(numbers)))
        self%data%numbers = numbers - 1
        self%data%c%struct_size = int(c_sizeof(self%data%c), c_int64_t)
        self%data%c%mesh = c_loc(self%data%asked%mesh)
        if (done%ok()) call done%refuse_if(size(numbers) == 0 .or. size(numbers) /= self%data%asked%mesh%n_points, &
            "numbers has not one number for each point")
        if (done%ok()) self%data%c%numbers = c_loc(self%data%numbers)
        if (present(ghosts)) then
            allocate(self%data%ghosts(size(ghosts)))
            self%data%ghosts = merge(1_c_int8_t, 0_c_int8_t, ghosts)
            if (done%ok()) call done%refuse_if(size(ghosts) /= self%data%asked%mesh%n_cells, &
                "ghosts has not one value for each cell")
            if (done%ok() .and. size(ghosts) > 0) self%data%c%ghosts = c_loc(self%data%ghosts)
        end if
        if (done%status < 0) call self%free()
        call done%finish("part%set", stat, err)
    end subroutine

    ! As C has them; null of a part that is not set.
    type(c_ptr) function part_mesh_address(self)
        class(hm_part), intent(in) :: self
        part_mesh_address = c_null_ptr
        if (associated(self%data)) part_mesh_address = c_loc(self%data%c)
    end function

    type(c_ptr) function part_problem_address(self)
        class(hm_part), intent(in) :: self
        part_problem_address = c_null_ptr
        if (associated(self%data)) part_problem_address = c_loc(self%data%asked%c)
    end function

    type(c_ptr) function part_options_address(self)
        class(hm_part), intent(in) :: self
        part_options_address = c_null_ptr
        if (associated(self%data)) part_options_address = c_loc(self%data%asked%options)
    end function

    subroutine part_free(self)
        class(hm_part), intent(inout) :: self
        if (.not. associated(self%data)) return
        call release(self%data%asked%arrays)
        if (associated(self%data%numbers)) deallocate(self%data%numbers)
        if (associated(self%data%ghosts)) deallocate(self%data%ghosts)
        deallocate(self%data)
        nullify(self%data)
    end subroutine
