
! ---- Analysis, plan and functions in W -------------------------------------------------------------------------------

contains

    ! Analyses the mesh, with the curves if wanted, until the call ends.
    subroutine analyse(this, with_curves, analysis)
        type(legacy_call), intent(inout) :: this
        logical, intent(in) :: with_curves
        type(c_ptr), intent(out) :: analysis
        type(hm_c_problem) :: problem
        type(c_ptr) :: block
        integer(c_size_t) :: bytes
        analysis = c_null_ptr
        if (.not. this%ok()) return
        associate (kept => this%kept)
            problem%struct_size = int(c_sizeof(problem), c_int64_t)
            problem%mesh = c_loc(kept%mesh)
            if (with_curves) then
                if (kept%set%n_curves > 0) problem%curves = c_loc(kept%set)
                problem%n_conditions = kept%n_conditions
                problem%conditions = c_loc(kept%condition)
            end if
            call this%told(hm_c_analysis_size(problem, c_loc(kept%options), bytes, this%e))
            call this%room(bytes, block)
            if (this%ok()) call this%told(hm_c_analysis_init(analysis, block, bytes, problem, c_loc(kept%options), &
                this%e))
        end associate
    end subroutine

    ! A plan of the analysis, until the call ends.
    subroutine make_plan(this, analysis, plan)
        type(legacy_call), intent(inout) :: this
        type(c_ptr), intent(in) :: analysis
        type(c_ptr), intent(out) :: plan
        type(c_ptr) :: block
        integer(c_size_t) :: bytes
        plan = c_null_ptr
        if (this%ok()) call this%told(hm_c_plan_size(analysis, bytes, this%e))
        call this%room(bytes, block)
        if (this%ok()) call this%told(hm_c_plan_init(plan, block, bytes, analysis, this%e))
    end subroutine

    ! The analysis of the mesh where HMSOLV found it, until the call ends.
    subroutine analysis_of_start(this, name, analysis)
        type(legacy_call), intent(inout) :: this
        character(len=*), intent(in) :: name
        type(c_ptr), intent(out) :: analysis
        type(c_ptr) :: same
        integer(c_int32_t) :: status
        analysis = c_null_ptr
        if (.not. this%ok()) return
        call this%refuse_if(this%kept%n_conditions == 0, name // " needs HMSOLV before it, HMLOAD is not enough")
        if (.not. this%ok()) return
        status = hm_c_basis_attach(same, this%kept%basis, int(bytes_of_functions(this), c_size_t), &
            c_loc(this%kept%mesh), &
            this%e)
        call this%refuse_if(status == hm_moved, "X, Y are no longer where HMSOLV found them")
        if (this%ok()) call this%told(status)
        call analyse(this, .true., analysis)
    end subroutine

    ! A plan for a safe movement from there, until the call ends.
    subroutine plan_of_start(this, name, plan)
        type(legacy_call), intent(inout) :: this
        character(len=*), intent(in) :: name
        type(c_ptr), intent(out) :: plan
        type(c_ptr) :: analysis
        plan = c_null_ptr
        call analysis_of_start(this, name, analysis)
        call make_plan(this, analysis, plan)
        call this%forgive()
    end subroutine

    ! The functions; keeps: matrix and factor stay as well, at the end of W.
    subroutine solve(w, keeps, resid, ierr, msg)
        real(c_double), intent(in) :: w(*)
        logical, intent(in) :: keeps
        real(c_double), intent(inout) :: resid
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        type(legacy_call) :: this
        type(hm_solve_report) :: report
        type(c_ptr) :: analysis, plan, basis, block
        integer(c_int64_t) :: plan_top
        integer(c_size_t) :: bytes
        call this%open(w)
        if (this%ok()) then
            associate (kept => this%kept, conditions => this%kept%condition(:this%kept%n_conditions))
                call this%refuse_if(kept%set%n_curves < 1 .and. &
                    all(conditions%kind /= hm_rigid .and. conditions%kind /= hm_given), &
                    "there is no curve and no rigid body: HMFIT, or HMCTRL and HMCURV, or HMRIGD")
            end associate
        end if
        if (this%ok()) call forget_functions(this%kept)
        if (this%ok()) this%top = this%kept%words
        call analyse(this, .true., analysis)
        call make_plan(this, analysis, plan)
        plan_top = this%top
        if (this%ok()) call this%told(hm_c_basis_size(analysis, bytes, this%e))
        call this%spare(bytes, block)
        if (this%ok()) call this%told(hm_c_basis_init(basis, block, bytes, analysis, this%e))
        if (this%ok()) call this%told(hm_c_plan_factor(plan, c_null_ptr, this%e))
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (this%ok()) call this%told(hm_c_plan_solve(plan, basis, report, this%e))
        if (this%ok()) then
            resid = report%residual
            call keep_functions(this, basis)
            if (keeps) then
                this%kept%plan = plan
                this%kept%words = plan_top
            end if
        end if
        call this%finish(ierr, msg)
    end subroutine

    integer(c_int64_t) function bytes_of_functions(this)
        type(legacy_call), intent(inout) :: this
        type(hm_c_basis_info) :: info
        info%struct_size = int(c_sizeof(info), c_int64_t)
        call this%told(hm_c_basis_info_get(this%kept%basis, info, this%e))
        bytes_of_functions = info%bytes
    end function

    ! From now on these functions, which lie behind the curves, stay.
    subroutine keep_functions(this, basis)
        type(legacy_call), intent(inout) :: this
        type(c_ptr), intent(in) :: basis
        integer(c_intptr_t) :: first
        if (.not. this%ok()) return
        first = transfer(basis, first)
        this%kept%basis = basis
        this%kept%used = (first - this%kept%here + bytes_of_functions(this) + 7) / 8
    end subroutine

    ! Instead of the functions in W these, which were made behind them and depend on nothing else.
    subroutine replace_functions(this, made)
        type(legacy_call), intent(inout) :: this
        type(c_ptr), intent(in) :: made
        integer(c_int8_t), pointer :: from(:), to(:)
        integer(c_int64_t) :: bytes, k
        if (.not. this%ok()) return
        this%kept%basis = made
        bytes = bytes_of_functions(this)
        call c_f_pointer(made, from, [bytes])
        call c_f_pointer(this%at(this%kept%curves_end + 1), to, [bytes])
        do k = 1, bytes                         ! upwards, as the two may overlap
            to(k) = from(k)
        end do
        call keep_functions(this, this%at(this%kept%curves_end + 1))
    end subroutine

    subroutine keep_condition(this, condition)
        type(legacy_call), intent(inout) :: this
        type(hm_c_condition), intent(in) :: condition
        if (this%ok()) call this%refuse_if(this%kept%n_conditions == most_conditions, "there are 64 conditions already")
        if (.not. this%ok()) return
        associate (n => this%kept%n_conditions)
            n = n + 1_c_int32_t
            this%kept%condition(n) = condition
            this%kept%condition(n)%struct_size = int(c_sizeof(condition), c_int64_t)
        end associate
    end subroutine

    ! What the use of HMFACT's factor begins with: working memory for one field of displacements.
    subroutine work_of_field(this, work, bytes)
        type(legacy_call), intent(inout) :: this
        type(c_ptr), intent(out) :: work
        integer(c_size_t), intent(out) :: bytes
        work = c_null_ptr
        bytes = 0
        if (this%ok()) call this%refuse_if(.not. c_associated(this%kept%plan), "HMFACT comes first")
        if (this%ok()) call this%told(hm_c_displace_size(this%kept%plan, 1_c_int32_t, bytes, this%e))
        call this%room(bytes, work)
    end subroutine

    ! One quantity of the curves after the movement dp, and g(2,control points), its derivatives by the control points.
    subroutine measure(this, name, what, dp, value, g)
        type(legacy_call), intent(inout) :: this
        character(len=*), intent(in) :: name
        type(hm_c_quantity), intent(in) :: what
        real(c_double), intent(in) :: dp(2, *)
        real(c_double), intent(inout) :: value
        real(c_double), intent(inout), target :: g(2, *)
        type(hm_c_basis_info) :: info
        type(hm_c_curves) :: set
        type(hm_c_curve) :: list(most_curves)
        type(hm_c_quantity) :: quantity(1)
        type(c_ptr) :: control
        real(c_double) :: found(1)
        info%struct_size = int(c_sizeof(info), c_int64_t)
        set%struct_size = int(c_sizeof(set), c_int64_t)
        list(1)%struct_size = int(c_sizeof(list(1)), c_int64_t)
        if (this%ok()) call this%told(hm_c_basis_info_get(this%kept%basis, info, this%e))
        call this%refuse_if(info%curves < 1, name // ": the functions have no curves")
        call this%room(16_c_size_t * info%control_points, control)
        if (this%ok()) call this%told(hm_c_moved_curves(this%kept%basis, dp, control, set, list, &
            int(most_curves, c_int32_t), this%e))
        quantity(1) = what
        quantity(1)%struct_size = int(c_sizeof(what), c_int64_t)
        if (this%ok()) call this%told(hm_c_measure(set, this%kept%section, 1_c_int32_t, quantity, found, c_null_ptr, &
            c_loc(g), this%e))
        if (this%ok()) value = found(1)
    end subroutine
