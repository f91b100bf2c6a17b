! Threads: the caller's own, and OpenMP.
module threads_tests
    use body_mesh
    implicit none
    private
    public :: threads
    integer :: tasks_seen = 0

contains

    subroutine threads()
        type(hm_executor) :: four
        type(hm_options) :: options
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: own
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        real(dp) :: move(2, n_control), gradient(2, n_control), expected(2, n_control)
        real(dp), dimension(n_points) :: a, b, dx, dy
        integer :: stat
        call basis%curves(curves)
        four%run => run_backwards
        four%n_threads = 4
        options%executor = four
        tasks_seen = 0
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
        call plan%factor()
        call plan%solve(own)
        call own%values(2, a)
        call basis%values(2, b)
        call check(same(a, b), "four threads, whose tasks run backwards: the same bits")
        call check(tasks_seen > 0, "there were tasks")
        move = some_move()
        call basis%displacement(move, a, b)
        call basis%adjoint(a, b, expected)
        call own%displacement(move, dx, dy, executor=four)
        call check(same(dx, a) .and. same(dy, b), "displacement on threads")
        call own%adjoint(dx, dy, gradient, executor=four)
        call check(maxval(abs(gradient - expected)) <= 0, "adjoint on threads")
        call own%assess(mesh, dx, dy, step, executor=four)
        call own%assess(mesh, quality, executor=four)
        call check(step%admissible > 0 .and. quality%inverted == 0, "step and quality on threads")
        call own%morph_to(move, x, y, a, b, executor=hm_openmp(2))
        call check(maxval(abs(a - x - dx)) < 1e-15_dp, "threads of OpenMP, if it is there")

        ! Each of them hands the executor on: 300 threads are refused.
        four%n_threads = 300
        call own%displacement(move, dx, dy, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "displacement on 300 threads")
        call own%adjoint(dx, dy, gradient, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "adjoint on 300 threads")
        call own%assess(mesh, quality, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "quality on 300 threads")
        call own%assess(mesh, quality, x, y, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "quality relative to other coordinates on 300 threads")
        call own%assess(mesh, dx, dy, step, quality, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "assessment on 300 threads")
    end subroutine

    ! The tasks one after the other, the last one first.
    subroutine run_backwards(n_threads, n_tasks, tasks)
        integer, intent(in) :: n_threads, n_tasks
        type(hm_tasks), intent(in) :: tasks
        integer :: k
        do k = n_tasks, 1, -1
            call tasks%run(k)
        end do
        tasks_seen = tasks_seen + n_tasks * min(n_threads, 1)
    end subroutine
end module
