
    ! ---- Functions: each process solves its share, then has the rows of its points -------------------------------

    interface hm_mpi_solve
!@each comm
        procedure :: solve_@FORM@
!@end
    end interface
    interface hm_mpi_exchange
!@each comm
        procedure :: exchange_@FORM@
!@end
    end interface
    interface hm_mpi_adjoint
!@each comm
        procedure :: adjoint_@FORM@
!@end
    end interface

contains

!@each comm
    ! The plan has a factor. basis receives the rows of points, with all functions.
    subroutine solve_@FORM@(plan, points, basis, comm, report, stat, err)
        type(hm_plan), intent(inout) :: plan
        integer(c_int32_t), intent(in), contiguous :: points(:)
        type(hm_basis), intent(inout) :: basis
        @KIND@, intent(in) :: comm
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_basis) :: share
        type(hm_error) :: reason
        integer :: rank, n_processes, first, n, solved, done
        call mpi_comm_rank(mpi_comm(number_of(comm)), rank)
        call mpi_comm_size(mpi_comm(number_of(comm)), n_processes)
        ! What fails on one process leaves an empty basis there, which all then refuse together.
        call plan%share_of(rank + 1, n_processes, first, n, solved, reason)
        if (solved >= 0) call share%init_share(plan, first, n, stat=solved, err=reason)
        if (solved >= 0) call plan%solve(share, report, solved, reason)
        if (solved < 0) call share%free()
        call basis%free()
        if (solved >= 0) call share%extract(points, basis, stat=done, err=reason)
        if (solved >= 0 .and. done < 0) solved = done
        if (solved >= 0) then
            call hm_mpi_exchange(basis, share, points, comm, done, reason)
        else
            call hm_mpi_exchange(basis, share, points, comm, done)   ! keeps the first reason
        end if
        if (done >= 0) done = solved
        if (done < 0) call basis%free()
        if (present(err)) err = reason
        if (present(stat)) then
            stat = done
        else if (done < 0) then
            write(error_unit, "(4a)") "harmorph: hm_mpi_solve: ", hm_status_name(done), ": ", trim(reason%text)
            error stop "harmorph: refused"
        end if
    end subroutine

    ! rows: made of this process's share by share%extract(points, rows).
    subroutine exchange_@FORM@(rows, share, points, comm, stat, err)
        type(hm_basis), intent(inout) :: rows
        type(hm_basis), intent(in) :: share
        integer(c_int32_t), intent(in), contiguous :: points(:)
        @KIND@, intent(in) :: comm
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = c_exchange(rows%address(), share%address(), int(size(points), c_int32_t), points, number_of(comm), e)
        call hm_finish("hm_mpi_exchange", status, e, stat, err)
    end subroutine

    ! gradient(2, functions): the same on all processes.
    subroutine adjoint_@FORM@(basis, dj_dx, dj_dy, gradient, comm, stat, err)
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in), contiguous, target :: dj_dx(:), dj_dy(:)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :)
        @KIND@, intent(in) :: comm
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_basis_info) :: info
        type(hm_c_error) :: e
        type(hm_c_points) :: dj
        type(c_ptr) :: room
        integer(c_int32_t) :: status
        integer :: known
        ! A NULL of one process is refused by all together.
        room = c_null_ptr
        call basis%info(info, known)
        if (known >= 0) then
            if (size(dj_dx) == info%points .and. size(dj_dy) == info%points .and. size(gradient, 1) == 2 .and. &
                size(gradient, 2) == info%functions) room = c_loc(gradient)
        end if
        if (size(dj_dx) > 0 .and. size(dj_dy) > 0) dj = hm_c_points(c_loc(dj_dx), c_loc(dj_dy), 1_c_int64_t)
        status = c_adjoint(basis%address(), dj, room, c_null_ptr, number_of(comm), e)
        call hm_finish("hm_mpi_adjoint", status, e, stat, err)
    end subroutine

!@end
