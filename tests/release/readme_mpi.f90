! The code around the lines of c_api/mpi/README.md: a mesh, the parts of the mesh, and products that must agree.
program parts
    use, intrinsic :: iso_fortran_env, only: dp => real64
    use mpi_f08
    use harmorph
    use harmorph_mpi
    use o_mesh
    implicit none
    integer, parameter :: ni = 65, nj = 17, wall = 1, far = 2, n = ni * nj
    real(dp), target :: whole_x(ni, nj), whole_y(ni, nj)
    real(dp), allocatable :: x(:), y(:), gx(:), gy(:), gradient(:, :), move(:, :)
    integer, allocatable :: points(:)
    type(hm_mesh) :: mesh
    type(hm_curves) :: curves
    type(hm_plan) :: plan
    type(hm_basis) :: basis
    real(dp) :: change
    integer :: rank, n_processes, i

    call MPI_Init()
    call MPI_Comm_rank(MPI_COMM_WORLD, rank)
    call MPI_Comm_size(MPI_COMM_WORLD, n_processes)
    call make_o_mesh(whole_x, whole_y, mesh, wall, far)
    call curves%fit(whole_x(:ni - 1, 1), whole_y(:ni - 1, 1), loop=.true., n_control=12)

    points = [(i, i = n * rank / n_processes + 1, n * (rank + 1) / n_processes)]
    x = [(whole_x(modulo(points(i) - 1, ni) + 1, (points(i) - 1) / ni + 1), i = 1, size(points))]
    y = [(whole_y(modulo(points(i) - 1, ni) + 1, (points(i) - 1) / ni + 1), i = 1, size(points))]
    gx = sin(x)
    gy = cos(2 * y)
    change = -dot_product(gx, x) - dot_product(gy, y)
    move = 0.05_dp * curves%control
    allocate(gradient(2, 12))
    include "readme_mpi.inc"
    change = change + dot_product(gx, x) + dot_product(gy, y)
    call MPI_Allreduce(MPI_IN_PLACE, change, 1, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    if (abs(change) < 1e-3_dp .or. abs(change - sum(gradient * move)) > 1e-12_dp) error stop "adjoint and morph differ"
    if (rank == 0) print "(a, i0)", "adjoint and morph agree on processes: ", n_processes
    call MPI_Finalize()
end program
