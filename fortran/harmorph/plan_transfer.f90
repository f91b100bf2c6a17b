
! ---- Functions taken over from a coarser mesh

contains
    ! Functions solved on a coarse mesh, for this denser one of the same domain: the plan needs no factor.
    subroutine plan_transfer(self, coarse, coarse_mesh, basis, report, work, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_basis), intent(in) :: coarse
        type(hm_mesh), intent(in) :: coarse_mesh
        type(hm_basis), intent(inout) :: basis
        type(hm_transfer_report), intent(out), optional :: report
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_transfer_report) :: its
        type(block_of_memory) :: block
        integer(c_size_t) :: bytes
        call need_analysis(self, done)
        call need_basis(coarse, done)
        if (done%ok() .and. .not. c_associated(basis%address())) call make_basis(basis, self, done=done)
        if (done%ok()) done%status = hm_c_transfer_size(self%analysis, c_mesh_of(coarse_mesh), bytes, done%error)
        call block%take(bytes, work, done)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (done%ok()) done%status = hm_c_transfer(basis%address(), block%start, block%bytes, self%analysis, &
            coarse%address(), c_mesh_of(coarse_mesh), its, done%error)
        if (present(report)) report = its
        call block%give_back()
        call done%finish("plan%transfer", stat, err)
    end subroutine

    integer(c_int64_t) function plan_transfer_words(self, coarse_mesh)
        class(hm_plan), intent(in) :: self
        type(hm_mesh), intent(in) :: coarse_mesh
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_transfer_words = 0
        if (hm_c_transfer_size(self%analysis, c_mesh_of(coarse_mesh), bytes, e) >= 0) &
            plan_transfer_words = words_of(bytes)
    end function

    ! Working space of morph_safe, of a basis made by combine or tabulate with that basis; 0 without prepare or factor.
    integer(c_int64_t) function plan_morph_safe_words(self, basis)
        class(hm_plan), intent(in) :: self
        type(hm_basis), intent(in), optional :: basis
        type(c_ptr) :: address
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_morph_safe_words = 0
        address = c_null_ptr
        if (present(basis)) address = basis%address()
        if (hm_c_morph_safe_size(self%plan, address, bytes, e) >= 0) plan_morph_safe_words = words_of(bytes)
    end function

    ! Working space of improve; 0 without prepare or factor.
    integer(c_int64_t) function plan_improve_words(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_improve_words = 0
        if (hm_c_improve_size(self%plan, bytes, e) >= 0) plan_improve_words = words_of(bytes)
    end function
