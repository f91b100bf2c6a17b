! harmorph for Fortran: morphs an airfoil and its CFD mesh together. MIT licence. Compile this file with your solver
! (gfortran -c harmorph.f90) and link libharmorph.a. harmorph.h says what is computed; here is how Fortran asks for it.
!
!     type(hm_mesh) :: mesh;  type(hm_curves) :: curves;  type(hm_plan) :: plan;  type(hm_basis) :: basis
!     call mesh%points(x, y)                       the solver's own arrays, viewed, not copied: give them TARGET
!     call mesh%cells(cells)                       (3,n), (4,n), or rows and their start; none for a block x(ni,nj)
!     call mesh%faces(face_points, markers)        or lists; line(...) for the sides of a block
!     call plan%analyse(mesh)                      the mesh alone: plan%report, plan%boundary
!     call curves%fit(x(wall), y(wall), loop)      or curves%set and curves%add
!     call plan%analyse(mesh, curves, [hm_condition(wing), hm_condition(tunnel, hm_slip)], options=options)
!     call plan%factor()
!     call plan%solve(basis)                       then plan%free(): the basis and the mesh are all that a morph needs
!     call basis%morph(move, x, y)                 move(2,functions); also morph_to, displacement, velocity, adjoint
!     call basis%admissible_step(mesh, dx, dy, report);  call basis%quality(mesh, x, y, report);  assess: both
!     call plan%morph_safe(basis, move, x, y)      a movement of any size without inverted cells; it needs the plan
!     call plan%transfer(coarse, coarse_mesh, basis)      functions of a coarser mesh instead of factor and solve
!     call basis%save(file);  call basis%load(file, mesh)
!     call basis%single(narrow)                    the functions in single precision: half the memory, faster morphs
!
! Operators     hm_options: the default is the conformal one; hm_laplace are the paper's harmonic functions.
! Layouts       Coordinates are x(:), y(:), or structured x(:,:), y(:,:). Any constant distance from point to point is
!               used as it lies: xy(1,:), xy(2,:) are not copied. Default reals, and blocks inside their ghost layers,
!               work too but are converted in a copy at each call. Connectivity is contiguous; 8-byte integers are
!               converted.
! Mesh          hm_mesh keeps the places of the arrays given to points, cells, faces and lists: they must outlive mesh
!               and plan and not be expressions. Of what had to be converted it has a copy: after such coordinates
!               change, call points again.
! Numbering     Everything counts from 1: points, cells, control points, functions, numbers of a value, curves, bodies,
!               pieces, conditions, parts. (Texts of errors count curves, conditions and functions from 0.)
! stat, err     stat: 0 done, above 0 a warning, below 0 refused: arrays are as before; a plan or basis that was to be
!               made anew is empty. Without stat, what is refused stops the program with the reason. err holds it too.
! Memory        Blocks are allocated here and freed by the type's finalisation or free(). Or give `work`, as many 8-byte
!               numbers as the procedure whose name ends in _words says; it must not move while in use.
! Assignment    Of a mesh, plan or basis: stops the program, as two owners would free one block. Curves are plain data.
! Threads       hm_openmp(n), where this file is compiled with OpenMP; or your own procedure in an hm_executor.
! Parts         Codes on several processes: share_of, init_share, extract, pack, unpack, adjoint_scale, _sums, _finish,
!               see harmorph.h.
module harmorph
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_f_procpointer, c_float, &
        c_funloc, c_funptr, c_int8_t, c_int32_t, c_int64_t, c_intptr_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, &
        c_ptr, c_size_t, c_sizeof
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none
    private
