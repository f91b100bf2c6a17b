! The whole plan: with functions taken over from a coarser mesh, and the working space of safe morphs.
module harmorph_plan
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int64_t, c_size_t, c_sizeof
    use harmorph_structs, only: hm_c_error, hm_transfer_report
    use harmorph_calls
    use harmorph_outcome, only: hm_error, outcome
    use harmorph_memory, only: block_of_memory, words_of
    use harmorph_mesh, only: c_mesh_of, hm_mesh
    use harmorph_analysis, only: analysis_of, need_analysis
    use harmorph_basis_core, only: make_basis, need_basis
    use harmorph_basis, only: hm_basis
    use harmorph_plan_core, only: plan_of
    use harmorph_plan_calls, only: plan_calls
    implicit none
    private

    type, extends(plan_calls), public :: hm_plan
    contains
        procedure :: transfer => plan_transfer
        procedure :: transfer_words => plan_transfer_words
        procedure :: morph_safe_words => plan_morph_safe_words
    end type

contains
    ! Functions solved on a coarse mesh, for this denser one of the same domain: the plan needs no factor.
    subroutine plan_transfer(self, coarse, coarse_mesh, basis, report, work, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_basis), intent(in) :: coarse
        type(hm_mesh), intent(in) :: coarse_mesh
        type(hm_basis), intent(inout) :: basis
        type(hm_transfer_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_transfer_report) :: its
        type(block_of_memory) :: block
        integer(c_size_t) :: bytes
        call need_analysis(self, done)
        call need_basis(coarse, done)
        if (done%ok() .and. .not. c_associated(basis%address())) call make_basis(basis, self, done=done)
        if (done%ok()) done%status = hm_c_transfer_size(analysis_of(self), c_mesh_of(coarse_mesh), bytes, done%error)
        call block%take(bytes, work, done)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (done%ok()) done%status = hm_c_transfer(basis%address(), block%start, block%bytes, analysis_of(self), &
            coarse%address(), c_mesh_of(coarse_mesh), its, done%error)
        if (present(report)) report = its
        call block%give_back()
        call done%finish(stat, err)
    end subroutine

    integer(c_int64_t) function plan_transfer_words(self, coarse_mesh)
        class(hm_plan), intent(in) :: self
        type(hm_mesh), intent(in) :: coarse_mesh
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_transfer_words = 0
        if (hm_c_transfer_size(analysis_of(self), c_mesh_of(coarse_mesh), bytes, e) >= 0) &
            plan_transfer_words = words_of(bytes)
    end function

    ! Working space of morph_safe; 0 without prepare or factor.
    integer(c_int64_t) function plan_morph_safe_words(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_morph_safe_words = 0
        if (hm_c_morph_safe_size(plan_of(self), bytes, e) >= 0) plan_morph_safe_words = words_of(bytes)
    end function
end module
