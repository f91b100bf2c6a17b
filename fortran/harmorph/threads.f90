
! ---- Threads and progress: Fortran's procedures, and the C structs and functions that call them ----------------------

    public :: hm_run, hm_progress, hm_openmp

    type, public :: hm_tasks                  ! the work of one call, for an executor
        private
        type(c_funptr) :: task = c_null_funptr
        type(c_ptr) :: context = c_null_ptr
    contains
        procedure :: run => tasks_run         ! call tasks%run(k)
    end type

    abstract interface
        ! Calls tasks%run(k) once for each k in 1 .. n_tasks, in any order, on any threads; returns when all are done.
        subroutine hm_run(n_threads, n_tasks, tasks)
            import :: hm_tasks
            implicit none
            integer, intent(in) :: n_threads, n_tasks
            type(hm_tasks), intent(in) :: tasks
        end subroutine
        ! Called at the start of each phase (fraction 0), sometimes in between, at its end (1). Set cancel to stop.
        subroutine hm_progress(phase, fraction, cancel)
            import :: c_double
            implicit none
            integer, intent(in) :: phase
            real(c_double), intent(in) :: fraction
            logical, intent(inout) :: cancel
        end subroutine
        subroutine c_task(context, index) bind(c)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value, intent(in) :: context
            integer(c_int32_t), value, intent(in) :: index
        end subroutine
    end interface

    type, public :: hm_executor
        procedure(hm_run), pointer, nopass :: run => null()     ! null: everything on the calling thread
        integer :: n_threads = 1                                ! 1 .. 256
        integer :: kernel = hm_kernel_auto                      ! hm_best_kernel(), asked once; auto: see harmorph.h
    end type

    type :: callback                          ! what C hands back as `user`
        procedure(hm_run), pointer, nopass :: run => null()
        procedure(hm_progress), pointer, nopass :: progress => null()
        integer :: n_threads = 1
    end type

    type :: c_threads                ! an executor of C, and the one of Fortran that it calls
        type(hm_c_executor) :: c
        type(callback) :: its
    end type

contains
    subroutine tasks_run(self, task)
        class(hm_tasks), intent(in) :: self
        integer, intent(in) :: task
        procedure(c_task), pointer :: run
        call c_f_procpointer(self%task, run)
        call run(self%context, int(task - 1, c_int32_t))
    end subroutine

    ! Threads of OpenMP, where this file is compiled with it (-fopenmp); otherwise the calling thread alone.
    function hm_openmp(n_threads) result(executor)
        integer, intent(in) :: n_threads
        type(hm_executor) :: executor
        executor%n_threads = 1
        executor%kernel = hm_best_kernel()
        !$ executor%n_threads = min(n_threads, 256)
        if (executor%n_threads /= 1) executor%run => run_openmp
        if (n_threads < 1) executor%n_threads = n_threads        ! the call will refuse it
    end function

    subroutine run_openmp(n_threads, n_tasks, tasks)
        integer, intent(in) :: n_threads, n_tasks
        type(hm_tasks), intent(in) :: tasks
        integer :: k
        !$omp parallel do schedule(dynamic, 1) num_threads(n_threads)
        do k = 1, n_tasks
            call tasks%run(k)
        end do
        if (n_threads < 0) return                                ! used without OpenMP, too
    end subroutine

    subroutine call_executor(user, n_tasks, task, context) bind(c, name="")
        type(c_ptr), value, intent(in) :: user
        integer(c_int32_t), value, intent(in) :: n_tasks
        type(c_funptr), value, intent(in) :: task
        type(c_ptr), value, intent(in) :: context
        type(callback), pointer :: its
        call c_f_pointer(user, its)
        call its%run(its%n_threads, int(n_tasks), hm_tasks(task, context))
    end subroutine

    function call_progress(user, phase, fraction) result(cancelled) bind(c, name="")
        type(c_ptr), value, intent(in) :: user
        integer(c_int32_t), value, intent(in) :: phase
        real(c_double), value, intent(in) :: fraction
        integer(c_int32_t) :: cancelled
        type(callback), pointer :: its
        logical :: cancel
        call c_f_pointer(user, its)
        cancel = .false.
        call its%progress(int(phase), fraction, cancel)
        cancelled = merge(1_c_int32_t, 0_c_int32_t, cancel)
    end function

    ! The C executor that calls the Fortran one; `threads` must outlive the call.
    function c_executor_of(executor, threads) result(address)
        type(hm_executor), intent(in), optional :: executor
        type(c_threads), intent(inout), target :: threads
        type(c_ptr) :: address
        address = c_null_ptr
        if (.not. present(executor)) return
        threads%c%struct_size = int(c_sizeof(threads%c), c_int64_t)
        threads%c%n_threads = int(executor%n_threads, c_int32_t)
        threads%c%kernel = int(executor%kernel, c_int32_t)
        threads%its%n_threads = executor%n_threads
        threads%its%run => executor%run
        if (associated(executor%run)) threads%c%run = c_funloc(call_executor)
        threads%c%user = c_loc(threads%its)
        address = c_loc(threads%c)
    end function
