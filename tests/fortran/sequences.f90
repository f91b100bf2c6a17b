! Random sequences of calls on a mesh that moves in its own arrays, in several layouts: after each call the wall and the
! rigid outer boundary are where formulas lead them.
module sequences_tests
    use meshes
    use counts
    implicit none
    private
    public :: sequences

    integer, parameter :: rows = n_control + 2                  ! control points, and the rigid body
    type :: moving
        real(dp), allocatable :: q(:, :)                        ! (4, n_points): x and y are rows of it, or columns
        real(dp), allocatable :: column(:, :)                   ! (n_points, 2)
        real(dp) :: x0(n_points), y0(n_points), total(2, rows)
        logical :: interleaved
    end type
    integer :: state = 1

contains

    real(dp) function any_number()                              ! -1 to 1
        state = modulo(1103 * state + 12345, 65536)
        any_number = state / 32768._dp - 1
    end function

    integer function any_of(n)                                  ! 1 to n
        integer, intent(in) :: n
        any_of = 1 + int(n * 0.4999_dp * (any_number() + 1))
    end function

    ! A movement by about the size; the body rotates by an angle [radian] beyond the rotation so far.
    function any_move(total, size) result(move)
        real(dp), intent(in) :: total(2, rows), size
        real(dp) :: move(2, rows)
        complex(dp) :: s
        integer :: k
        do k = 1, rows - 1
            move(:, k) = size * [any_number(), any_number()]
        end do
        s = (1 + cmplx(total(1, rows), total(2, rows), dp)) * (exp(cmplx(0, size * any_number(), dp)) - 1)
        move(:, rows) = [real(s, dp), aimag(s)]
    end function

    subroutine now(this, x, y)
        type(moving), intent(in) :: this
        real(dp), intent(out) :: x(n_points), y(n_points)
        if (this%interleaved) then
            x = this%q(2, :)
            y = this%q(4, :)
        else
            x = this%column(:, 1)
            y = this%column(:, 2)
        end if
    end subroutine

    subroutine put(this, x, y)
        type(moving), intent(inout) :: this
        real(dp), intent(in) :: x(n_points), y(n_points)
        if (this%interleaved) then
            this%q(2, :) = x
            this%q(4, :) = y
        else
            this%column(:, 1) = x
            this%column(:, 2) = y
        end if
    end subroutine

    subroutine sequences()
        integer :: k
        do k = 1, 10
            call sequence(modulo(k, 2) == 0, [hm_conformal, hm_laplace, hm_weighted])
        end do
    end subroutine

    subroutine sequence(interleaved, operators)
        logical, intent(in) :: interleaved
        integer, intent(in) :: operators(3)
        type(moving), target :: this
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        type(hm_basis) :: basis, first
        type(hm_curves) :: curves
        integer(c_int32_t), target :: cells(4, n_cells), faces(2, 2 * around), markers(2 * around)
        real(dp) :: x(n_points), y(n_points), move(2, rows), centre(2)
        real(dp), pointer, contiguous :: reached(:, :)
        integer, allocatable :: wall(:)
        integer :: k
        logical :: loop
        this%interleaved = interleaved
        allocate(this%q(4, n_points), this%column(n_points, 2), source=0._dp)
        call make_points(this%x0, this%y0)
        call make_cells(cells, faces, markers)
        call put(this, this%x0, this%y0)
        if (interleaved) then
            call mesh%points(this%q(2, :), this%q(4, :))
        else
            call mesh%points(this%column(:, 1), this%column(:, 2))
        end if
        call mesh%cells(cells)
        call mesh%faces(faces, markers)
        call plan%analyse(mesh)
        call plan%boundary([body], wall, loop)
        call curves%fit(this%x0(wall), this%y0(wall), loop, n_control=n_control)
        call put_on_curve(this, curves, wall)
        centre = [any_number(), any_number()]
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(marker=far_field, kind=hm_rigid, &
            x=centre(1), y=centre(2))], options=hm_options(operator_kind=operators(any_of(3))))
        call plan%factor()
        call plan%solve(basis)
        call plan%solve(first)
        this%total = 0
        allocate(reached(2, rows))
        do k = 1, 6
            move = any_move(this%total, 0.005_dp)
            call now(this, x, y)
            select case (any_of(4))
            case (1)
                if (interleaved) then
                    call basis%morph(move, this%q(2, :), this%q(4, :))
                else
                    call basis%morph(move, this%column(:, 1), this%column(:, 2))
                end if
                this%total = this%total + move
            case (2)
                call basis%morph_mesh(move, mesh)
                this%total = this%total + move
            case (3)                                            ! solved anew where the mesh is now, and moved safely
                if (any_of(2) == 1) then
                    call plan%factor()
                else
                    call plan%factor(x, y)
                end if
                call plan%solve(basis)
                call plan%morph_safe(basis, move, x, y, options=hm_safe_options(reached=reached))
                call put(this, x, y)
                this%total = this%total + reached
            case (4)
                call basis%save("sequences.tmp")
                call basis%load("sequences.tmp")
            end select
            call check_places(this, basis, first, centre)
        end do
        deallocate(reached)
    end subroutine

    ! Offsets of points from the curve would rotate where the safe morph takes several steps.
    subroutine put_on_curve(this, curves, wall)
        type(moving), intent(inout) :: this
        type(hm_curves), intent(in) :: curves
        integer, intent(in) :: wall(:)
        real(dp) :: u, distance, xy(2, 0:0)
        integer :: k
        do k = 1, size(wall)
            call curves%project(1, this%x0(wall(k)), this%y0(wall(k)), u, distance)
            call curves%point(1, u, xy)
            this%x0(wall(k)) = xy(1, 0)
            this%y0(wall(k)) = xy(2, 0)
        end do
        call put(this, this%x0, this%y0)
    end subroutine

    subroutine check_places(this, basis, first, centre)
        type(moving), intent(in) :: this
        type(hm_basis), intent(in) :: basis, first
        real(dp), intent(in) :: centre(2)
        real(dp), dimension(n_points) :: x, y, dx, dy
        real(dp) :: found(2, rows), move(2, rows), gradient(2, rows), error
        complex(dp) :: at
        integer :: k
        call now(this, x, y)
        call first%boundary_error(this%total, this%x0, this%y0, x, y, error)
        call check(error < 1e-12_dp, "the wall is on the B-spline")
        error = 0
        do k = n_points - around + 1, n_points
            at = (1 + cmplx(this%total(1, rows), this%total(2, rows), dp)) * &
                cmplx(this%x0(k) - centre(1), this%y0(k) - centre(2), dp) + &
                cmplx(centre(1) + this%total(1, rows - 1), centre(2) + this%total(2, rows - 1), dp)
            error = max(error, abs(at - cmplx(x(k), y(k), dp)))
        end do
        call check(error < 1e-12_dp, "the body is rigid")
        call basis%recover(x, y, found)
        call check(maxval(abs(found - this%total)) < 1e-9_dp, "the whole movement is recovered")
        move = any_move(this%total, 0.01_dp)
        call basis%displacement(move, dx, dy)
        call basis%adjoint(x, y, gradient)
        call check(abs(sum(x * dx + y * dy) - sum(gradient * move)) < 1e-10_dp, "the adjoint is the transpose")
    end subroutine
end module
