! The flow solver of potential.f90 for C: procedures with bind(C), which give C the addresses of the solver's arrays.
module potential_c
    use, intrinsic :: iso_c_binding
    use potential, only: alpha, cells, cp, cp_target, dp, faces, gradient, marks, nc, np, objective, read_mesh, &
        solve_flow, x, y
    implicit none

    ! struct flow of design_c.c: the mesh, with points counted from 1, and cells of four points each.
    type, bind(c) :: flow
        integer(c_int32_t) :: points, cells, faces
        type(c_ptr) :: x, y, cell_points, face_points, face_markers
    end type

contains

    ! Reads the mesh. The name of the file ends with a zero byte.
    subroutine flow_read(file, mesh) bind(c)
        character(kind=c_char), intent(in) :: file(*)
        type(flow), intent(out) :: mesh
        character(len=256) :: name
        integer :: k
        name = ""
        do k = 1, len(name)
            if (file(k) == c_null_char) exit
            name(k:k) = file(k)
        end do
        call read_mesh(trim(name))
        mesh = flow(int(np, c_int32_t), int(nc, c_int32_t), int(size(marks), c_int32_t), c_loc(x), c_loc(y), &
            c_loc(cells), c_loc(faces), c_loc(marks))
    end subroutine

    ! The pressure of the present airfoil at an incidence that is higher by `more` becomes the wanted one.
    subroutine flow_want(more) bind(c)
        real(c_double), value, intent(in) :: more
        alpha = alpha + more
        call solve_flow()
        cp_target = cp
        alpha = alpha - more
    end subroutine

    ! The objective on the present mesh, and its derivatives by the coordinates of the mesh points.
    real(c_double) function flow_objective(gx, gy) bind(c)
        real(c_double), intent(out) :: gx(np), gy(np)
        call solve_flow()
        flow_objective = objective()
        call gradient(gx, gy)
    end function
end module
