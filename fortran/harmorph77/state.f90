module harmorph77
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int32_t, c_int64_t, c_int8_t, &
        c_intptr_t, c_loc, c_null_ptr, c_ptr, c_size_t, c_sizeof
    use harmorph
    implicit none
    public

    integer, parameter :: most_curves = 16, most_conditions = 64

! ---- What W keeps from one call to the next --------------------------------------------------------------------------

    ! At the beginning of W. Behind it, upwards: arrays of the mesh, then control points and curves, then the functions.
    ! From the end of W downwards: the plan that HMFACT keeps, then what one call needs.
    type, bind(c) :: state
        integer(c_intptr_t) :: here = 0         ! the address of W, by which the work of HMOPEN is known
        integer(c_int64_t) :: all_words = 0     ! of W
        integer(c_int64_t) :: words = 0         ! of W, without the plan that HMFACT keeps
        integer(c_int64_t) :: mesh_end = 0      ! how many words the state and the arrays of the mesh take
        integer(c_int64_t) :: curves_end = 0    ! with the curves
        integer(c_int64_t) :: used = 0          ! with the functions
        type(hm_c_mesh) :: mesh
        type(c_ptr) :: plane = c_null_ptr       ! of HMPLAN
        type(hm_c_curves) :: set
        type(hm_c_curve) :: curve(most_curves)
        type(hm_c_section) :: section
        type(hm_c_condition) :: condition(most_conditions)
        integer(c_int32_t) :: n_conditions = 0
        ! Of HMALNG: the curve of each condition, in the caller's arrays.
        type(hm_c_curves) :: along(most_conditions)
        type(hm_c_curve) :: along_curve(most_conditions)
        type(hm_c_options) :: options
        type(c_ptr) :: basis = c_null_ptr
        type(c_ptr) :: plan = c_null_ptr
    end type

contains

    ! A new W. The numbers of bytes of its structs tell the library which fields they have.
    subroutine begin(kept, here, words)
        type(state), intent(out) :: kept
        type(c_ptr), intent(in) :: here
        integer(c_int64_t), intent(in) :: words
        kept%here = transfer(here, kept%here)
        kept%all_words = words
        kept%options%struct_size = int(c_sizeof(kept%options), c_int64_t)
        kept%mesh_end = words_of(c_sizeof(kept))
        call forget_curves(kept)
    end subroutine

    ! Curves, conditions and functions.
    subroutine forget_curves(kept)
        type(state), intent(inout) :: kept
        kept%curves_end = kept%mesh_end
        kept%set = hm_c_curves(index_base=1)
        kept%set%struct_size = int(c_sizeof(kept%set), c_int64_t)
        kept%section = hm_c_section()
        kept%section%struct_size = int(c_sizeof(kept%section), c_int64_t)
        kept%n_conditions = 0
        call forget_functions(kept)
    end subroutine

    ! And the plan that HMFACT keeps.
    subroutine forget_functions(kept)
        type(state), intent(inout) :: kept
        kept%used = kept%curves_end
        kept%basis = c_null_ptr
        kept%plan = c_null_ptr
        kept%words = kept%all_words
    end subroutine

    integer(c_int64_t) function words_of(bytes)
        integer(c_size_t), intent(in) :: bytes
        words_of = int((bytes + 7) / 8, c_int64_t)
    end function

    ! x(1), x(1+inc), ... as C has them.
    type(hm_c_points) function points_of(x, y, inc)
        real(c_double), intent(in), target :: x(*), y(*)
        integer, intent(in) :: inc
        points_of = hm_c_points(c_loc(x), c_loc(y), int(max(inc, 1), c_int64_t))
    end function
