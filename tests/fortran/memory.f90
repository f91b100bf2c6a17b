! Memory of the caller, and who shares what a mesh has copied.
module memory_tests
    use, intrinsic :: iso_c_binding, only: c_int64_t
    use body_mesh
    use kept, only: analyse, complete, values
    implicit none
    private
    public :: own_memory, working_memory, shared_with_plans

contains

    subroutine own_memory()
        real(dp), allocatable, target :: analysis(:), plan_block(:), basis_block(:), from_far_below(:)
        integer(c_int64_t) :: words
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: own
        real(dp) :: a(n_points), b(n_points)
        type(hm_error) :: err
        integer :: stat
        call basis%curves(curves)
        call hm_analysis_words(words, mesh, curves, [hm_condition(body)])
        allocate(analysis(words))
        call plan%analyse(mesh, curves, [hm_condition(body)], work=analysis(2:), stat=stat, err=err)
        call check(stat == hm_block_too_small .and. err%value > 0, "work of the analysis 8 bytes too small")
        call plan%analyse(mesh, curves, [hm_condition(body)], work=analysis(::2), stat=stat)
        call check(stat == hm_bad_argument, "work that is not contiguous")
        allocate(from_far_below(-5000:words - 5001))
        call plan%analyse(mesh, curves, [hm_condition(body)], work=from_far_below)
        call plan%free()
        call plan%analyse(mesh, curves, [hm_condition(body)], work=analysis)
        allocate(plan_block(plan%plan_words()), basis_block(plan%basis_words()))
        call plan%prepare(plan_block(2:), stat)
        call check(stat == hm_block_too_small, "work of the plan too small")
        call plan%prepare(plan_block)
        call own%init(plan, basis_block(2:), stat)
        call check(stat == hm_block_too_small, "work of the basis too small")
        call own%init(plan, basis_block)
        call plan%drop_analysis()
        analysis = -1
        call plan%factor()
        call plan%solve(own)
        call plan%free()
        plan_block = -1
        call own%values(4, a)
        call basis%values(4, b)
        call check(same(a, b), "the same functions in own memory")
        call own%free()
        basis_block = -1
        call check(same(basis_block(:1), [-1._dp]), "own memory is not freed")
    end subroutine

    subroutine working_memory()
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        type(hm_curves) :: curves
        real(dp), allocatable, target :: work(:), every_second(:, :)
        real(dp), pointer :: nothing(:)
        type(hm_error) :: err
        integer :: stat
        call mesh%points(x, y)
        call complete(mesh)
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        allocate(every_second(2, plan%basis_words()))
        call basis%init(plan, every_second(1, :), stat, err)
        call check(stat == hm_bad_argument, "work that is not contiguous: " // err%text)
        nullify(nothing)
        call basis%init(plan, nothing, stat, err)
        call check(stat == hm_bad_argument, "work that is nothing: " // err%text)
        allocate(work(2 * plan%basis_words()))
        call basis%init(plan, work(3:), stat)
        call check(stat == hm_ok, "a part of an array as work")
    end subroutine

    ! A plan has its share of the mesh's copies; the mesh may go on without it.
    subroutine shared_with_plans()
        type(hm_mesh), allocatable :: mesh
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        real(dp) :: found(n_points)
        integer :: stat
        allocate(mesh)
        call mesh%points(x, y)
        call complete(mesh)
        call analyse(plan, mesh)
        call mesh%cells(cells(:, :1))
        call plan%factor(stat=stat)
        call check(stat == hm_ok, "cells that a mesh gets later are not the plan's")
        deallocate(mesh)
        call plan%factor()
        call plan%solve(basis)
        call basis%values(3, found)
        call check(maxval(abs(found - values)) <= 0, "a plan outlives the mesh")
    end subroutine
end module
