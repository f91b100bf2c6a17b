! The flow of potential.f90 on several processes: the stream function psi on linear triangles, each process with its own
! cells and no process with the mesh. psi is y on the far field and 0 on the airfoil; the objective is the energy of the
! flow, half the integral of |grad psi|**2, whose derivatives by the mesh points need no second solution. harmorph moves
! the mesh, with PETSc, and carries the derivatives to the control points; finite differences check them.
!
!     mpirun -np 4 ./partitioned naca0012.su2
module partitioned_flow
    use, intrinsic :: iso_fortran_env, only: dp => real64, int64
    use mpi_f08
    use read_su2, only: read_su2_mesh, su2_marker, su2_mesh
    implicit none
    integer, parameter :: airfoil = 1, far_field = 2
    integer :: rank, n_processes, np, nt
    real(dp), allocatable, target :: x(:), y(:)
    integer, allocatable, target :: tri(:, :), faces(:, :), marks(:)
    integer(int64), allocatable :: numbers(:)   ! global numbers of the points
    integer, allocatable :: border(:), place(:) ! points that other processes have too, and their places in the sums
    integer :: n_border                         ! of all processes
    real(dp), allocatable :: psi(:), wall_or_far(:)

contains

    ! The part of a process: a stripe of the file's cells. A code with larger meshes reads no more than this.
    subroutine read_part(file)
        character(len=*), intent(in) :: file
        type(su2_mesh) :: from
        integer, allocatable :: local(:), touched(:)
        integer :: k, m, c, first, last, n_cells, face(2)
        call read_su2_mesh(file, from)
        n_cells = size(from%start) - 1
        first = int(int(n_cells, int64) * rank / n_processes) + 1
        last = int(int(n_cells, int64) * (rank + 1) / n_processes)
        allocate(local(size(from%x)), touched(size(from%x)), tri(3, 2 * (last - first + 1)))
        local = 0
        np = 0
        nt = 0
        do k = first, last
            m = from%start(k)
            do c = m, from%start(k + 1) - 1
                if (local(from%cells(c)) > 0) cycle
                np = np + 1
                local(from%cells(c)) = np
            end do
            nt = nt + 1
            tri(:, nt) = local(from%cells(m:m + 2))
            if (from%start(k + 1) - m == 3) cycle
            nt = nt + 1
            tri(:, nt) = local(from%cells([m, m + 2, m + 3]))
        end do
        tri = tri(:, :nt)
        allocate(x(np), y(np), numbers(np), faces(2, 0), marks(0))
        do k = 1, size(local)
            if (local(k) == 0) cycle
            x(local(k)) = from%x(k)
            y(local(k)) = from%y(k)
            numbers(local(k)) = k
        end do
        do k = 1, size(from%markers)            ! faces whose cell is here
            face = local(from%faces(:, k))
            if (any(face == 0)) cycle
            do c = 1, nt
                if (any(tri(:, c) == face(1)) .and. any(tri(:, c) == face(2))) exit
            end do
            if (c > nt) cycle
            faces = reshape([faces, face], [2, size(marks) + 1])
            marks = [marks, merge(airfoil, far_field, from%markers(k) == su2_marker(from, "airfoil"))]
        end do
        where (local > 0)
            touched = 1
        elsewhere
            touched = 0
        end where
        call find_border(touched)
    end subroutine

    ! touched(points of the file): 1 if the point is here. A code with larger meshes has lists of its neighbours.
    subroutine find_border(touched)
        integer, intent(inout) :: touched(:)
        integer :: k
        integer, allocatable :: order(:)
        call MPI_Allreduce(MPI_IN_PLACE, touched, size(touched), MPI_INTEGER, MPI_SUM, MPI_COMM_WORLD)
        allocate(order(size(touched)))
        n_border = 0
        do k = 1, size(touched)
            if (touched(k) > 1) n_border = n_border + 1
            order(k) = merge(n_border, 0, touched(k) > 1)
        end do
        border = pack([(k, k = 1, np)], order(int(numbers)) > 0)
        place = order(int(numbers(border)))
        allocate(psi(np), wall_or_far(np))
        wall_or_far = 0                         ! 1 at points whose psi is known
        do k = 1, size(marks)
            wall_or_far(faces(:, k)) = 1
        end do
        call add_up(wall_or_far)
        wall_or_far = min(wall_or_far, 1._dp)
    end subroutine

    ! Contributions of all processes at the points of several.
    subroutine add_up(field)
        real(dp), intent(inout) :: field(:)
        real(dp) :: sums(n_border)
        sums = 0
        sums(place) = field(border)
        call MPI_Allreduce(MPI_IN_PLACE, sums, n_border, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
        field(border) = sums(place)
    end subroutine

    ! K field of the process's own cells; their energy; and the derivatives of the energy by their points.
    subroutine apply(field, product, energy, gx, gy)
        real(dp), intent(in) :: field(:)
        real(dp), intent(out) :: product(:)
        real(dp), intent(out), optional :: energy, gx(:), gy(:)
        real(dp) :: b(3), c(3), area2, u, v
        integer :: k, t(3), n
        product = 0
        if (present(energy)) energy = 0
        if (present(gx)) gx = 0
        if (present(gy)) gy = 0
        do k = 1, nt
            t = tri(:, k)
            b = [y(t(2)) - y(t(3)), y(t(3)) - y(t(1)), y(t(1)) - y(t(2))]
            c = [x(t(3)) - x(t(2)), x(t(1)) - x(t(3)), x(t(2)) - x(t(1))]
            area2 = b(1) * c(2) - b(2) * c(1)
            u = dot_product(b, field(t))
            v = dot_product(c, field(t))
            product(t) = product(t) + (b * u + c * v) / (2 * abs(area2))
            if (present(energy)) energy = energy + (u**2 + v**2) / (4 * abs(area2))
            if (.not. present(gx) .or. .not. present(gy)) cycle
            do n = 1, 3                         ! the quotient (u**2 + v**2) / (4 |area2|): d area2 / dx_n is b_n
                gx(t(n)) = gx(t(n)) + v * (field(t(modulo(n + 1, 3) + 1)) - field(t(modulo(n, 3) + 1))) * (-1) / &
                    (2 * abs(area2)) - b(n) * (u**2 + v**2) / (4 * area2 * abs(area2))
                gy(t(n)) = gy(t(n)) + u * (field(t(modulo(n + 1, 3) + 1)) - field(t(modulo(n, 3) + 1))) / &
                    (2 * abs(area2)) - c(n) * (u**2 + v**2) / (4 * area2 * abs(area2))
            end do
        end do
    end subroutine

    ! Of points of several processes each has the same value: counted once by the process to which it belongs.
    real(dp) function inner(a, b, mine)
        real(dp), intent(in) :: a(:), b(:)
        logical, intent(in) :: mine(:)
        inner = sum(a * b, mask=mine)
        call MPI_Allreduce(MPI_IN_PLACE, inner, 1, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    end function

    ! Conjugate gradients; far: psi on the far field, where the airfoil has 0.
    subroutine solve_flow(far, mine)
        real(dp), intent(in) :: far(:)
        logical, intent(in) :: mine(:)
        real(dp), dimension(np) :: r, p, q
        real(dp) :: rho, last, goal
        integer :: step
        psi = far * wall_or_far
        call apply(psi, r)
        call add_up(r)
        r = -r * (1 - wall_or_far)
        p = r
        rho = inner(r, r, mine)
        goal = 1e-20_dp * rho
        do step = 1, 20 * 1000
            if (rho <= goal) exit
            call apply(p, q)
            call add_up(q)
            q = q * (1 - wall_or_far)
            last = rho / inner(p, q, mine)
            psi = psi + last * p
            r = r - last * q
            last = rho
            rho = inner(r, r, mine)
            p = r + (rho / last) * p
        end do
    end subroutine

    real(dp) function energy_of_flow(gx, gy)
        real(dp), intent(out) :: gx(:), gy(:)
        real(dp) :: product(np)
        call apply(psi, product, energy_of_flow, gx, gy)
        call MPI_Allreduce(MPI_IN_PLACE, energy_of_flow, 1, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    end function
end module

program partitioned
    use harmorph
    use harmorph_mpi, only: hm_mpi_adjoint
    use harmorph_petsc
    use partitioned_flow
    implicit none
    integer, parameter :: n_control = 14, n_outline = 200
    type(hm_mesh) :: mesh
    type(hm_curves) :: curves
    type(hm_petsc) :: system
    type(hm_basis) :: basis
    type(hm_petsc_report) :: report
    type(hm_step_report) :: limit
    type(hm_quality_report) :: quality
    real(dp) :: outline(2, n_outline), t, thickness, move(2, n_control), gradient(2, n_control), energy(3), slope, &
        difference, step
    real(dp), allocatable :: dx(:), dy(:), gx(:), gy(:), far(:), x_start(:), y_start(:)
    logical, allocatable :: mine(:)
    character(len=256) :: file
    integer :: k

    call MPI_Init()
    call MPI_Comm_rank(MPI_COMM_WORLD, rank)
    call MPI_Comm_size(MPI_COMM_WORLD, n_processes)
    call get_command_argument(1, file)
    call read_part(trim(file))
    allocate(dx(np), dy(np), gx(np), gy(np), far(np), mine(np))

    ! The airfoil's outline is known to all: NACA 0012 with a sharp edge.
    do k = 1, n_outline
        t = 0.5_dp + 0.5_dp * cos(6.283185307179586_dp * (k - 1) / n_outline)
        thickness = t * (-0.126_dp + t * (-0.3516_dp + t * (0.2843_dp - t * 0.1036_dp)))
        thickness = 0.6_dp * (0.2969_dp * sqrt(t) + thickness)
        outline(:, k) = [t, merge(thickness, -thickness, 2 * (k - 1) < n_outline)]
    end do

    call hm_petsc_initialise()
    call mesh%points(x, y)
    call mesh%cells(tri)
    call mesh%faces(faces, marks)
    call curves%fit(outline(1, :), outline(2, :), loop=.true., n_control=n_control)
    call system%create(mesh, numbers, curves, [hm_condition(airfoil)], MPI_COMM_WORLD)
    call system%solve(basis, report)
    call system%owned(mine)

    move = 0
    where (curves%control(2, :) > 0.01_dp) move(2, :) = 0.02_dp    ! the upper side rises
    call basis%displacement(move, dx, dy)
    call system%assess(basis, dx, dy, limit, quality)

    x_start = x
    y_start = y
    far = y                                     ! on the far field; the airfoil's points stay at 0
    do k = 1, size(marks)
        if (marks(k) == airfoil) far(faces(:, k)) = 0
    end do
    call keep_airfoil(far)
    step = 1e-4_dp
    do k = 3, 1, -1
        x = x_start + (k - 2) * step * dx
        y = y_start + (k - 2) * step * dy
        call solve_flow(far, mine)
        energy(k) = energy_of_flow(gx, gy)
        if (k == 2) call hm_mpi_adjoint(basis, gx, gy, gradient, MPI_COMM_WORLD)
    end do
    slope = sum(gradient * move)
    difference = (energy(3) - energy(1)) / (2 * step)
    call basis%morph_to(move, x_start, y_start, x, y)
    call system%assess(basis, dx, dy, limit, quality)
    call system%free()
    if (rank == 0) then
        print "(i0, a, i0, a)", report%unknowns, " unknowns on ", n_processes, " processes"
        print "(a, f0.2, a, i0, a)", "the mesh can follow ", limit%admissible, " times as far; ", quality%inverted, &
            " inverted cells"
        print "(a, 2es20.12)", "slope of the energy, by the adjoint and by differences: ", slope, difference
    end if
    if (abs(slope - difference) > 1e-5_dp * abs(slope)) error stop "the derivatives disagree"
    if (quality%inverted > 0) error stop "the mesh is not valid"
    call hm_petsc_finalise()
    call MPI_Finalize()

contains
    ! Points of the airfoil whose faces are on another process have psi = 0, too.
    subroutine keep_airfoil(field)
        real(dp), intent(inout) :: field(:)
        real(dp) :: on_airfoil(np)
        integer :: face
        on_airfoil = 0
        do face = 1, size(marks)
            if (marks(face) == airfoil) on_airfoil(faces(:, face)) = 1
        end do
        call add_up(on_airfoil)
        where (on_airfoil > 0) field = 0
    end subroutine
end program
