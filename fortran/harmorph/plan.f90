
! ---- A plan: an analysed mesh, matrix and factor; the type, and what is common to the parts that follow --------------

    type, public :: hm_safe_options                             ! of morph_safe; 0 are the defaults
        integer :: max_resolves = 0
        integer :: skipped_strategies = 0                       ! sum of 2**hm_strategy_... of those not to be tried
        real(c_double) :: heights = 0                           ! 0 .. 1: how far distances from walls are brought back
        real(c_double) :: min_quality = 0                       ! of the start's smallest; 0: 0.05; negative: any
        real(c_double) :: max_height_change = 0                 ! of first-layer heights, a factor above 1; 0: any
        ! (2, :) like move: receives the movement that x_new has; short of the target it is not all of move.
        real(c_double), pointer, contiguous :: reached(:, :) => null()
    end type

    type, public :: hm_plan
        private
        type(problem), pointer :: data => null()
        type(block_of_memory) :: analysis_memory, plan_memory
        type(c_ptr) :: analysis = c_null_ptr, plan = c_null_ptr
    contains
        ! Analysis
        procedure :: analyse => plan_analyse
        procedure :: report => plan_report
        procedure :: boundary => plan_boundary
        procedure :: plan_words
        procedure :: basis_words
        procedure :: share_words
        procedure :: share_of => plan_share_of
        procedure :: drop_analysis
        ! Matrix, factor and solution
        procedure :: prepare => plan_prepare
        procedure, private :: plan_factor
        generic :: factor => plan_factor
        procedure :: solve => plan_solve
        procedure :: level => plan_level
        ! Coordinates
!@each form
        procedure, private :: factor_@FORM@, morph_safe_@FORM@, improve_@FORM@, slide_@FORM@, slide_adjoint_@FORM@
        generic :: factor => factor_@FORM@
        generic :: morph_safe => morph_safe_@FORM@
        generic :: improve => improve_@FORM@
        generic :: slide => slide_@FORM@
        generic :: slide_adjoint => slide_adjoint_@FORM@
!@end
        procedure :: address => plan_address
        ! Given displacements
        procedure :: given_points => plan_given_points
        procedure :: displacements => plan_displacements
        procedure :: displace_adjoints => plan_displace_adjoints
!@each form
        procedure, private :: displace_@FORM@, plan_displacement_@FORM@, displace_adjoint_@FORM@, displace_safe_@FORM@
        generic :: displace => displace_@FORM@
        generic :: displacement => plan_displacement_@FORM@
        generic :: velocity => plan_displacement_@FORM@
        generic :: displace_adjoint => displace_adjoint_@FORM@
        generic :: displace_safe => displace_safe_@FORM@
!@end
        procedure :: morph_safe_words => plan_morph_safe_words
        procedure :: improve_words => plan_improve_words
        ! Functions by table
        procedure, private :: tabulate_real, tabulate_complex
        generic :: tabulate => tabulate_real, tabulate_complex
        ! Coarse to fine
        procedure :: transfer => plan_transfer
        procedure :: transfer_words => plan_transfer_words
        procedure :: free => plan_free
        procedure, private :: plan_assign
        generic :: assignment(=) => plan_assign
        final :: plan_final
    end type

contains
    ! For C, null before prepare or factor.
    type(c_ptr) function plan_address(self)
        class(hm_plan), intent(in) :: self
        plan_address = self%plan
    end function

    ! ---- Plan: memory

    ! Saves memory: after prepare or factor, and basis%init, nobody needs the analysis.
    subroutine drop_analysis(self)
        class(hm_plan), intent(inout) :: self
        self%analysis = c_null_ptr
        call self%analysis_memory%give_back()
    end subroutine

    subroutine plan_free(self)
        class(hm_plan), intent(inout) :: self
        self%plan = c_null_ptr
        call self%plan_memory%give_back()
        call self%drop_analysis()
        if (associated(self%data)) then
            call release(self%data%arrays)
            deallocate(self%data)
        end if
        nullify(self%data)
    end subroutine

    impure elemental subroutine plan_final(self)
        type(hm_plan), intent(inout) :: self
        call self%free()
    end subroutine

    subroutine plan_assign(to, from)
        class(hm_plan), intent(inout) :: to
        class(hm_plan), intent(in) :: from
        if (associated(to%data) .or. associated(from%data) .or. .true.) error stop "harmorph: a plan cannot be assigned"
    end subroutine

    subroutine need_analysis(self, done)
        class(hm_plan), intent(in) :: self
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. c_associated(self%analysis), "the plan has no analysis: call analyse first")
    end subroutine

    integer(c_int32_t) function n_points_of(self)
        class(hm_plan), intent(in) :: self
        n_points_of = self%data%mesh%n_points
    end function

