! This module gives harmorph the mesh of one plane of code_saturne's mesh, the same on every process. Points are known
! by their coordinates x, y, which have the same bits in both planes and on all processes. The factor takes a fraction
! of a second for meshes of this kind, so every process computes it; nothing is sent in a time step.
module moving_mesh
    use harmorph
    implicit none
    private
    integer, parameter :: dp = kind(1d0)
    public :: start_mesh, follow_wall, quality_of
    integer, parameter :: wall = 1, outside = 2
    type(hm_mesh) :: plane
    type(hm_plan) :: plan
    type(hm_basis) :: judge
    real(dp), allocatable, target :: x(:), y(:), dx(:), dy(:)
    integer, allocatable :: cells(:, :), faces(:, :), marks(:), given(:), point_of(:)

contains

    ! Finds the mesh of the plane and factors the matrix. start has the coordinates of the points of this process before
    ! any movement.
    subroutine start_mesh(start)
        real(dp), intent(in) :: start(:, :)
        real(dp), allocatable :: corners(:, :), on_wall(:, :), on_outside(:, :), sorted(:, :)
        integer, allocatable :: order(:)
        integer :: k, n

        call collect("3 and z > 0.05", 4, start, corners)
        call collect("1", 2, start, on_wall)
        call collect("2", 2, start, on_outside)
        allocate(order(size(corners, 2)))
        order = [(k, k = 1, size(order))]
        call sort(corners, order)
        sorted = corners(:, order)
        n = 1
        do k = 2, size(order)
            if (any(sorted(:, k) /= sorted(:, n))) then
                n = n + 1
                sorted(:, n) = sorted(:, k)
            end if
        end do
        x = sorted(1, :n)
        y = sorted(2, :n)
        allocate(dx(n), dy(n))
        cells = reshape([(place(corners(:, k)), k = 1, size(corners, 2))], [4, size(corners, 2) / 4])
        faces = reshape([(place(on_wall(:, k)), k = 1, size(on_wall, 2)), &
            (place(on_outside(:, k)), k = 1, size(on_outside, 2))], [2, (size(on_wall, 2) + size(on_outside, 2)) / 2])
        allocate(marks(size(faces, 2)), source=outside)
        marks(:size(on_wall, 2) / 2) = wall
        point_of = [(place(start(1:2, k)), k = 1, size(start, 2))]

        call plane%points(x, y)
        call plane%cells(cells)
        call plane%faces(faces, marks)
        call plan%analyse(plane, conditions=[hm_condition(wall, hm_given)])
        call plan%factor()
        call plan%given_points(given)
        call judge%init(plan)
    end subroutine

    ! Computes the displacements of all points of this process when the wall turns by an angle about the origin.
    subroutine follow_wall(angle, displacement)
        real(dp), intent(in) :: angle
        real(dp), intent(out) :: displacement(:, :)
        real(dp) :: moved(2, size(given))
        moved(1, :) = (cos(angle) - 1) * x(given) - sin(angle) * y(given)
        moved(2, :) = sin(angle) * x(given) + (cos(angle) - 1) * y(given)
        call plan%displacement(moved, dx, dy)
        displacement(1, :) = dx(point_of)
        displacement(2, :) = dy(point_of)
        displacement(3, :) = 0
    end subroutine

    ! Returns the smallest quality of the cells, relative to the start. now has the coordinates of the points of this
    ! process.
    function quality_of(now) result(least)
        use parall, only: irangp, parrmx
        real(dp), intent(in) :: now(:, :)
        real(dp) :: least, at(size(x), 2)
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        at = -huge(least)
        at(point_of, :) = transpose(now(1:2, :))
        if (irangp >= 0) call parrmx(size(x), at(:, 1))
        if (irangp >= 0) call parrmx(size(x), at(:, 2))
        call judge%assess(plane, at(:, 1) - x, at(:, 2) - y, step, quality)
        least = merge(0._dp, quality%min_quality, quality%inverted > 0)
    end function

    ! Collects the x, y of the corners of the faces that `criterion` chooses, of all processes. A face has m corners
    ! with different x, y, which follow each other.
    subroutine collect(criterion, m, start, corners)
        use mesh, only: nfabor, ipnfbr, nodfbr
        use parall, only: irangp, parcpt, paragv
        character(len=*), intent(in) :: criterion
        integer, intent(in) :: m
        real(dp), intent(in) :: start(:, :)
        real(dp), allocatable, intent(out) :: corners(:, :)
        real(dp), allocatable :: own(:, :), of_all(:)
        integer :: list(nfabor), n, k, i, found, all
        call getfbr(criterion, n, list)
        allocate(own(2, m * n))
        do k = 1, n
            found = 0
            do i = ipnfbr(list(k)), ipnfbr(list(k) + 1) - 1
                associate (at => start(1:2, nodfbr(i)), mine => own(:, m * (k - 1) + 1:m * (k - 1) + found))
                    if (any(mine(1, :) == at(1) .and. mine(2, :) == at(2))) cycle
                end associate
                found = found + 1
                own(:, m * (k - 1) + found) = start(1:2, nodfbr(i))
            end do
            if (found /= m) call stop_run("A boundary face has another number of points than expected.")
        end do
        all = m * n
        if (irangp >= 0) call parcpt(all)
        if (all == 0) call stop_run("No face of the boundary is in: " // criterion)
        if (irangp < 0) then
            corners = own
            return
        end if
        allocate(of_all(2 * all))
        call paragv(2 * m * n, 2 * all, reshape(own, [2 * m * n]), of_all)
        corners = reshape(of_all, [2, all])
    end subroutine

    subroutine stop_run(text)
        use entsor, only: nfecra
        character(len=*), intent(in) :: text
        write(nfecra, "(2a)") "moving_mesh: ", text
        call csexit(1)
    end subroutine

    logical function before(a, b)
        real(dp), intent(in) :: a(2), b(2)
        before = a(1) < b(1) .or. (a(1) == b(1) .and. a(2) < b(2))
    end function

    ! Sorts the points that `order` lists, by merging.
    recursive subroutine sort(at, order)
        real(dp), intent(in) :: at(:, :)
        integer, intent(inout) :: order(:)
        integer :: left(size(order) / 2), i, k, m
        m = size(order) / 2
        if (m == 0) return
        call sort(at, order(:m))
        call sort(at, order(m + 1:))
        left = order(:m)
        i = 1
        k = m + 1
        do while (i <= m)
            if (k > size(order)) then
                order(i + k - m - 1:) = left(i:)
                return
            end if
            if (before(at(:, order(k)), at(:, left(i)))) then
                order(i + k - m - 1) = order(k)
                k = k + 1
            else
                order(i + k - m - 1) = left(i)
                i = i + 1
            end if
        end do
    end subroutine

    ! Returns the number of the point of the plane at these coordinates, by bisection.
    integer function place(at)
        real(dp), intent(in) :: at(2)
        integer :: high, middle
        place = 1
        high = size(x)
        do while (place < high)
            middle = (place + high) / 2
            if (before([x(middle), y(middle)], at)) then
                place = middle + 1
            else
                high = middle
            end if
        end do
        if (x(place) /= at(1) .or. y(place) /= at(2)) call stop_run("The points of both planes differ in x and y.")
    end function
end module
