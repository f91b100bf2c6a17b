
! ---- Functions in memory: how a basis is made

contains
    ! Memory for the functions; solve does it by itself where memory need not be given.
    subroutine basis_init(self, plan, work, stat, err)
        class(hm_basis), intent(inout) :: self
        class(hm_plan), intent(in) :: plan
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call make_basis(self, plan, work, done)
        call done%finish("basis%init", stat, err)
    end subroutine

    subroutine make_basis(self, plan, work, done)
        class(hm_basis), intent(inout) :: self
        class(hm_plan), intent(in) :: plan
        real(c_double), pointer, intent(in), optional :: work(:)
        type(outcome), intent(inout) :: done
        integer(c_size_t) :: bytes
        call self%free()
        call need_analysis(plan, done)
        if (done%ok()) done%status = hm_c_basis_size(plan%analysis, bytes, done%error)
        call self%memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_basis_init(self%handle, self%memory%start, self%memory%bytes, &
            plan%analysis, done%error)
        call count_points(self, done)
        self%all_functions = done%status >= 0
    end subroutine

    ! Without taking from the caller what was given for it.
    pure logical function can_be_made_anew(basis)
        class(hm_basis), intent(in) :: basis
        can_be_made_anew = basis%all_functions .and. basis%memory%allocated_here()
    end function

    ! Functions of design variables: another basis, which needs this one no longer. matrix(control points,variables); a
    ! complex one as of curves%map.
    subroutine combine_real(self, matrix, combined, work, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: matrix(:, :)
        class(hm_basis), intent(inout) :: combined
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call combine_rows(self, shape(matrix), 1, reshape(transpose(matrix), [size(matrix)]), combined, work, stat, err)
    end subroutine

    subroutine combine_complex(self, matrix, combined, work, stat, err)
        class(hm_basis), intent(in) :: self
        complex(c_double), intent(in) :: matrix(:, :)
        class(hm_basis), intent(inout) :: combined
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double), allocatable :: pairs(:, :, :)
        allocate(pairs(2, size(matrix, 2), size(matrix, 1)))
        pairs(1, :, :) = transpose(real(matrix, c_double))
        pairs(2, :, :) = transpose(aimag(matrix))
        call combine_rows(self, shape(matrix), 2, reshape(pairs, [size(pairs)]), combined, work, stat, err)
    end subroutine

    subroutine combine_rows(self, extents, numbers, rows, combined, work, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: extents(2), numbers
        real(c_double), intent(in) :: rows(:)
        class(hm_basis), intent(inout) :: combined
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_basis_info) :: info
        integer(c_int32_t) :: n
        integer(c_size_t) :: bytes
        n = int(extents(2), c_int32_t)
        call combined%free()
        call need_basis(self, done)
        if (done%ok()) then
            call self%info(info)
            call done%refuse_if(extents(1) /= info%functions - 2 * info%bodies - info%modes, &
                "matrix must have a row for each control point")
        end if
        if (done%ok()) done%status = hm_c_combine_size(self%handle, n, int(numbers, c_int32_t), bytes, done%error)
        call combined%memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_combine(combined%handle, combined%memory%start, combined%memory%bytes, &
            self%handle, n, int(numbers, c_int32_t), rows, done%error)
        call count_points(combined, done)
        call done%finish("basis%combine", stat, err)
    end subroutine

    ! The functions in single precision, but on the wall: another basis, which needs this one no longer.
    subroutine basis_single(self, narrow, work, stat, err)
        class(hm_basis), intent(in) :: self
        class(hm_basis), intent(inout) :: narrow
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_size_t) :: bytes
        call narrow%free()
        call need_basis(self, done)
        if (done%ok()) done%status = hm_c_single_size(self%handle, bytes, done%error)
        call narrow%memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_single_init(narrow%handle, narrow%memory%start, narrow%memory%bytes, &
            self%handle, done%error)
        call count_points(narrow, done)
        call done%finish("basis%single", stat, err)
    end subroutine

    ! 8-byte numbers of work for the functions in single precision; 0 of a basis that cannot have them.
    integer(c_int64_t) function basis_single_words(self)
        class(hm_basis), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        basis_single_words = 0
        if (hm_c_single_size(self%handle, bytes, e) >= 0) basis_single_words = words_of(bytes)
    end function

    ! Memory for functions first .. first+n-1 alone, n >= 0: a share, which solve fills.

    subroutine basis_init_share(self, plan, first, n, work, stat, err)
        class(hm_basis), intent(inout) :: self
        class(hm_plan), intent(in) :: plan
        integer, intent(in) :: first, n
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_size_t) :: bytes
        call self%free()
        call need_analysis(plan, done)
        if (done%ok()) done%status = hm_c_share_size(plan%analysis, int(first - 1, c_int32_t), int(n, c_int32_t), &
            bytes, done%error)
        call self%memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_share_init(self%handle, self%memory%start, self%memory%bytes, &
            plan%analysis, int(first - 1, c_int32_t), int(n, c_int32_t), done%error)
        call count_points(self, done)
        call done%finish("basis%init_share", stat, err)
    end subroutine

    ! The rows of some points: a basis for the part of the mesh that a process has, in the order of the list.
    subroutine basis_extract(self, points, rows, work, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: points(:)
        class(hm_basis), intent(inout) :: rows
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t) :: n
        integer(c_size_t) :: bytes
        call rows%free()
        n = int(size(points), c_int32_t)
        call need_basis(self, done)
        if (done%ok()) done%status = hm_c_extract_size(self%handle, n, bytes, done%error)
        call rows%memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_extract_init(rows%handle, rows%memory%start, rows%memory%bytes, &
            self%handle, n, int(points, c_int32_t), done%error)
        call count_points(rows, done)
        call done%finish("basis%extract", stat, err)
    end subroutine

    ! 8-byte numbers of work for an extract of n points; 0 of a basis that is not solved.
    integer(c_int64_t) function basis_extract_words(self, n)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: n
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        basis_extract_words = 0
        if (hm_c_extract_size(self%handle, int(n, c_int32_t), bytes, e) >= 0) &
            basis_extract_words = words_of(bytes)
    end function

    ! A basis that lies in an array already: shared memory, a message, a file. With a mesh: is it the mesh's?
    subroutine basis_attach(self, block, mesh, stat, err)
        class(hm_basis), intent(inout) :: self
        real(c_double), pointer, intent(in) :: block(:)
        type(hm_mesh), intent(in), optional :: mesh
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call self%free()
        call self%memory%take(8_c_size_t, block, done)
        call attach_block(self, mesh, done)
        call done%finish("basis%attach", stat, err)
    end subroutine

    subroutine attach_block(self, mesh, done)
        class(hm_basis), intent(inout) :: self
        type(hm_mesh), intent(in), optional :: mesh
        type(outcome), intent(inout) :: done
        type(hm_c_mesh), target :: its
        type(c_ptr) :: address
        call done%check_version()
        address = c_null_ptr
        if (present(mesh)) then
            its = c_mesh_of(mesh)
            address = c_loc(its)
        end if
        if (done%ok()) done%status = hm_c_basis_attach(self%handle, self%memory%start, self%memory%bytes, address, &
            done%error)
        call count_points(self, done)
    end subroutine

    ! The library's object, for its other bindings; null: none.
    type(c_ptr) function basis_address(self)
        class(hm_basis), intent(in) :: self
        basis_address = self%handle
    end function

    ! Nothing stays of a basis that failed.
    subroutine count_points(self, done)
        class(hm_basis), intent(inout) :: self
        type(outcome), intent(in) :: done
        type(hm_c_basis_info) :: info
        type(hm_c_error) :: e
        if (done%status >= 0) then
            info%struct_size = int(c_sizeof(info), c_int64_t)
            if (hm_c_basis_info_get(self%handle, info, e) < 0) return
            self%counts%points = info%points
            self%counts%functions = info%functions
            self%counts%numbers = info%numbers_per_value
        else
            call self%free()
        end if
    end subroutine

    subroutine basis_free(self)
        class(hm_basis), intent(inout) :: self
        self%handle = c_null_ptr
        call self%memory%give_back()
        self%counts = basis_counts()
        self%all_functions = .false.
    end subroutine

    impure elemental subroutine basis_final(self)
        type(hm_basis), intent(inout) :: self
        call self%free()
    end subroutine

    subroutine basis_assign(to, from)
        class(hm_basis), intent(inout) :: to
        class(hm_basis), intent(in) :: from
        if (to%counts%points >= 0 .or. from%counts%points >= 0) error stop "harmorph: a basis cannot be assigned"
    end subroutine

    ! ---- Basis: checks

    subroutine need_basis(self, done)
        class(hm_basis), intent(in) :: self
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. c_associated(self%handle), "the basis is empty: solve, read or attach it first")
    end subroutine

    subroutine check_view(v, n, done)
        type(view), intent(in) :: v
        integer(c_int64_t), intent(in) :: n
        type(outcome), intent(inout) :: done
        character(len=112) :: text
        call done%refuse_if(v%wrong /= "", v%wrong)
        if (done%status < 0 .or. v%n == n) return
        write(text, "(a, i0, a, i0)") "an array holds ", v%n, " points, the mesh has ", n
        call done%refuse(text)
    end subroutine

    ! Is there a basis, and does v have its points?
    subroutine check_points(self, v, done)
        class(hm_basis), intent(in) :: self
        type(view), intent(in) :: v
        type(outcome), intent(inout) :: done
        call need_basis(self, done)
        call check_view(v, self%counts%points, done)
    end subroutine

    subroutine check_pairs(self, pairs, done)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: pairs(:, :)
        type(outcome), intent(inout) :: done
        character(len=112) :: text
        call need_basis(self, done)
        if (size(pairs, 1) == 2 .and. size(pairs, 2, kind=c_int64_t) == self%counts%functions) return
        write(text, "(a, i0, a)") "a movement, or a gradient, must be (2,", self%counts%functions, ")"
        call done%refuse(text)
    end subroutine

    subroutine check_sums(self, sums, done)
        class(hm_basis), intent(in) :: self
        integer(c_int64_t), intent(in) :: sums(:)
        type(outcome), intent(inout) :: done
        integer(c_int64_t) :: n
        character(len=112) :: text
        call need_basis(self, done)
        n = 4 * self%counts%functions * self%counts%numbers
        if (size(sums, kind=c_int64_t) == n) return
        write(text, "(a, i0, a)") "sums must be (", n, ")"
        call done%refuse(text)
    end subroutine

    ! A block of so many bytes that does not hold a basis yet; attach_block comes next.
    subroutine room_for(self, n, bytes, done)
        class(hm_basis), intent(inout) :: self
        integer(c_int64_t), intent(in) :: n
        integer(c_int8_t), pointer, intent(out) :: bytes(:)
        type(outcome), intent(inout) :: done
        nullify(bytes)
        call self%memory%take(int(max(n, 0_c_int64_t), c_size_t), done=done)
        if (done%ok()) call c_f_pointer(self%memory%start, bytes, [n])
    end subroutine
