! harmorph for Fortran: morphs an airfoil and its CFD mesh together. MIT licence.
!
! Compile this file with the flow solver (gfortran -c harmorph.f90; Fortran 2008 or later) and link libharmorph.a.
! Tested with gfortran 12 and flang 19. The head of this file is the manual; harmorph.h has the mathematics and the
! options in full, under the same names.
!
! ORDER OF CALLS
!
!     type(hm_mesh) :: mesh;  type(hm_curves) :: curves;  type(hm_plan) :: plan;  type(hm_basis) :: basis
!     call mesh%points(x, y)                       begins a mesh; the arrays have TARGET and are not copied
!     call mesh%cells(cells)                       (3,n), (4,n), or rows and their start; none for a block x(ni,nj)
!     call mesh%polygons(cells, start)             instead of cells: rows of 3 to 1024 points, with hanging nodes
!     call mesh%blocks(sizes, markers)             instead of cells: ni, nj of structured blocks, their sides' markers
!     call mesh%add_block(x, y, markers)           instead of points and blocks: once for each block in its own arrays
!     call mesh%faces(face_points, markers)        or lists, point_types; line(...) for the sides of a block
!     call plan%analyse(mesh)                      the mesh alone: plan%report, plan%boundary
!     call curves%fit(x(wall), y(wall), loop)      or curves%set and curves%add
!     call plan%analyse(mesh, curves, [hm_condition(wing), hm_condition(tunnel, hm_slip)], options=options)
!     call plan%factor()                           matrix and factor, on the coordinates as they are now
!     call plan%solve(basis)                       then plan%free(): the basis and the mesh are all that a morph needs
!     call basis%displacement(move, dx, dy)        move(2,functions): of each control point; nothing moves yet
!     call basis%admissible_step(mesh, dx, dy, report);  call basis%quality(mesh, x, y, report);  assess: both
!     call basis%morph(move, x, y)                 in place; also morph_to, morph_at, velocity, adjoint
!     call plan%morph_safe(basis, move, x, y)      a movement of any size without inverted cells; it needs the plan
!     call plan%improve(x, y, x0, y0)              after a movement from x0, y0: better cells inside; needs the plan
!     call plan%displacement(wall, dx, dy)         displacements or velocities of wall points, wall(2,n), carried to all
!                                                  mesh points: no curves, no basis; displace_adjoint: the transpose
!     call plan%displace_safe(basis, wall, x, y)   of any size without inverted cells; basis: empty, or for curves
!     call plan%transfer(coarse, coarse_mesh, basis)      functions of a coarser mesh instead of factor and solve
!     call basis%save(file);  call basis%load(file, mesh)
!     call curves%measure([hm_quantity(hm_area), hm_quantity(hm_thickness, 0.25_dp)], values, gradients=g)
!     call curves%map(hm_variables(hm_cst, n_upper=6, n_lower=6), matrix)     d(control points) / d(variables)
!     call basis%combine(matrix, few)              functions of those variables: few%morph(v, x, y), v(2,variables)
!     call plan%tabulate(basis, modes, more)       functions for modes(n,m) at the points of markers with hm_given
!     call curves%refine(1, [0.3_dp], finer);  call curves%elevate(1, finer)  more control points, the same shape
!     call basis%single(narrow)                    the functions in single precision: half the memory, faster morphs
!
! A basis serves any number of morphs. Solving into a basis that was used before makes it anew. The functions belong to
! the mesh they were solved on; morph_to(move, x0, y0, x, y) from the first mesh adds up no errors, morph moves on from
! x, y.
!
! THE MESH
!
! Coordinates   x(:), y(:), or structured x(:,:), y(:,:), of double precision or default reals. The mesh keeps where the
!               arrays lie, and every call reads the coordinates as they are at that moment: the arrays must outlive
!               mesh and plan, and must not be allocated anew. Sections as xy(1,:), xy(2,:) are used as they lie;
!               default reals, blocks inside ghost layers and nodes whose size is no multiple of 8 bytes are converted
!               at each call. The arguments of points are pointers with intent(in): the compiler refuses ("no specific
!               subroutine for the generic points") an array without TARGET, and expressions. Vector subscripts,
!               x([1,2]), which gfortran passes as a copy, are not possible.
! Derived types With coordinates inside nodes, give the addresses, the bytes from node to node, and the number of nodes:
!                   type(node_type), allocatable, target :: node(:)
!                   call mesh%points_at(c_loc(node(1)%x), c_loc(node(1)%y), storage_size(node) / 8, size(node))
!                   call basis%morph_at(move, c_loc(node(1)%x), c_loc(node(1)%y), storage_size(node) / 8, size(node))
!               (use, intrinsic :: iso_c_binding, only: c_loc). points(node%x, node%y) does the same where the compiler
!               passes components in place (flang); gfortran 12 does not, which is found out and refused. It also passes
!               POINTER dummy arguments that point to components wrongly to any procedure: use morph_at there, too.
! Blocks        With add_block, points of all blocks, one after the other, are the mesh's: displacements, derivatives,
!               numbers in reports. mesh%scatter(k, dx, dy, x, y) takes those of block k out of dx(:), dy(:),
!               mesh%gather(k, gx, gy, all_gx, all_gy) puts them there, basis%morph_mesh(move, mesh) moves the arrays of
!               all blocks in place. The blocks may lie inside ghost layers: add_block(x(1:ni,1:nj), y(1:ni,1:nj)).
! Connectivity  Integers of 4 or 8 bytes, sections and expressions: the mesh has copies of them (12 to 16 bytes a cell).
!               Further calls of cells add cells, whose numbers run on: triangles, then quads. Further faces, lists and
!               lines are added, too. points begins anew. A plan shares the copies: it goes on if the mesh is freed or
!               changed.
! Boundary      Each boundary edge has a marker, any integer: by faces(points(2,n), markers(n)); by lists(points, start,
!               markers), points in order, the first one again at the end of a closed list; by line(...) of a block; or
!               by point_types(types(n)): 0 for inner points, otherwise a marker; an edge between two types has the
!               larger one. Edges on no marker must be a cut, as O- and C-meshes have, with both sides at the same
!               coordinates. Markers without a condition are fixed.
! Orientation   Clockwise, counter-clockwise or mixed. A cell is inverted if a corner of it has no positive area, where
!               the sense in which most of the mesh's area runs counts as positive. analyse with curves refuses such
!               meshes.
! Numbering     Everything counts from 1: points, cells, control points, functions, numbers of a value, curves, bodies,
!               pieces, conditions, parts, and all of them in errors. points(x, y, first=0): points and cells count from
!               0 in the caller's lists and in reports.
!
! THREE DIMENSIONS
!
! hm_plane      Solvers with three dimensions and a mesh one cell thick: between parallel planes of any direction, in
!               any number of layers, or a wedge about an axis. Arrays are x(:), y(:), z(:) or
!               x(:,:,:), y(:,:,:), z(:,:,:).
!                   type(hm_plane) :: plane
!                   call plane%points(x, y, z)           copied until find
!                   call plane%faces(faces)              (3,n) or (4,n) of one symmetry plane: the plane's cells
!                   call plane%sides(sides, markers)     (4,n) faces of the boundary from one layer to the next
!                   call plane%find()                    or kind=hm_wedge, axis_point=, axis=, tolerance=
!                   call plane%mesh(mesh)                then curves, plan, basis; plane must outlive mesh
!                   call plane%morph(basis, move, x, y, z);  call plane%adjoint(basis, gx, gy, gz, gradient)
!               displacement, velocity; spread and gather for displacements from elsewhere; info: who follows whom.
!               See hm_plane_init in harmorph.h for what is refused.
!
! CURVES AND CONDITIONS
!
! curves%fit    B-spline by least squares through ordered points; loop: the last is joined to the first, which is not
!               repeated. plan%boundary gives the points of a marker in this order. n_control (20), degree (3), closed.
!               curves%control(2,n), weights, curve(k)%degree, knots, indices are plain data, to be read and changed.
! Conditions    hm_condition(marker): on curve 1; first_curve=, n_curves= for others. A section with a blunt base has
!               two curves: n_curves=size(curves%curve); without that the call is refused. hm_condition(marker, kind):
!               hm_fixed; hm_slip, along lines and smooth curves, or along=curves, a pointer to hm_curves that
!               plan%analyse reads, along these (basis%conditions gives no curves: refused until along is set again,
!               first_curve being 0); hm_free, with the Laplace and weighted operators; hm_rigid with body=, x=, y=;
!               hm_periodic_pair with partner=; hm_rotation_pair with partner=, x=, y=, one passage of an annulus;
!               hm_given, points that move by displacements that are given from call to call.
!               Of several markers of a point the first of these holds: on curve, rigid, given, fixed, slip, free.
!               piece=1, near_x=, near_y=: only the piece of the marker that is nearest to a point, as one of several
!               bodies, or one side of a channel.
! hm_options    0 or null is the default of each: operator_kind hm_conformal (keeps angles; complex functions) or
!               hm_laplace (the paper's harmonic ones), scheme, engine, precision, tolerance, executor, progress, ...
!               see harmorph.h.
! move          move(2, functions): dx, dy of each control point; after them, for each rigid body, its translation, then
!               s - 1 with s = scale * (cos a, sin a) for a turn by a.
!
! wall          wall(2,n): displacements of all points of markers with hm_given, in the order of plan%given_points, or
!               of the argument points(n). plan%displace(wall, x, y) moves the mesh in place, displacement gives dx, dy,
!               displacements several fields wall(2,n,m) at once. Factor once, displace as often as wished;
!               basis%assess, of a basis made by basis%init(plan), tells when to factor again, on x, y.
!
! REPORTS
!
! hm_mesh_report    plan%report: points, used_points, cells, triangles, quads, polygons, edges, boundary_edges,
!                   boundary_loops;
!                   inverted, first_inverted (-1: none); min_area (of a corner: half the cross product of its edges),
!                   min_quality, mean_quality (0 .. 1).
! hm_fit_report     max_error, rms_error (distances of the points), max_error_point; closed: hm_open, hm_tied,
!                   hm_periodic; first_point, where the curve begins; base_points on a blunt base, a second curve.
! hm_solve_report   residual and residual_function (relative, largest); boundary_error, where the functions on the
!                   curves differ from the B-spline's; partition_defect, of their sum from 1; min_value, max_value;
!                   max_distance, of a wall point from its curve, which is kept; unknowns, functions, curve_points,
!                   iterations, ...
! hm_step_report    admissible: the largest s for which x + t dx has no inverted cell for all t < s; cell, point: what
!                   limits it (-1: nothing does).
! hm_quality_report inverted, first_inverted, min_area; min_quality, mean_quality, min_quality_cell (size-skew, 0 .. 1);
!                   self_crossing 1: the boundary crosses itself, at crossing_points(4), two faces.
! hm_safe_report    strategy: hm_strategy_linear, ..., what moved the mesh last; step_fraction of the way (below 1: stat
!                   hm_short); admissible, cell, point of the last step tried; steps, resolves, other (0: none),
!                   untangled; quality, angles and first-layer heights of the mesh reached; worst(:n_worst), its cells
!                   of lowest quality, with their places; start_quality; turned_offset, see HM_STRATEGY_... in
!                   harmorph.h.
! hm_improve_report min_quality_before, mean_quality_before, min_quality, mean_quality (size-skew, relative to the
!                   mesh as analysed), min_quality_cell_before, min_quality_cell; iterations, movable points.
! hm_transfer_report  points, outside, max_distance, wall_correction: how well the coarse mesh resolves the functions.
!
! ERRORS
!
! stat, err     The last arguments of every call. stat: 0 done; above 0 done, with a warning (hm_not_converged,
!               hm_moved, hm_short, hm_poor, hm_backtracks, hm_far_from_curve); below 0 refused: the caller's arrays
!               are as before; a plan or basis that was to be made anew is empty. err%code is stat, err%text one
!               sentence, err%item the first offending point, cell, marker, ... (-1: none), err%value what was found.
!               Without stat, a call that is refused, or returns hm_not_converged or hm_short, prints its name and
!               the reason, and stops the program. Other warnings need stat to be seen.
!
! MEMORY AND OWNERSHIP
!
! Blocks        They are allocated here and freed by the type's finalisation or free(). Or give `work`, an array with
!               TARGET of as many 8-byte numbers as the procedure whose name ends in _words says; it must stay while in
!               use. Large blocks begin where huge pages of 2 MiB may begin. Where Linux gives such pages only on
!               request (/sys/kernel/mm/transparent_hugepage/enabled: madvise), the C library of GNU requests them if
!               the program runs with GLIBC_TUNABLES=glibc.malloc.hugetlb=1: morphs of large meshes are faster then.
! Kept          As they lie: coordinates, work, the block of basis%attach, options%history. Procedures given as progress
!               or executor must outlive the plan. Everything else is copied. A basis keeps nothing of mesh, curves or
!               plan.
! Assignment    Of a mesh, plan or basis: stops the program, as two owners would free one block. Curves are plain data.
! Threads       hm_openmp(n), where this file is compiled with OpenMP; or your own procedure in an hm_executor. The
!               results have the same bits for any number of threads. hm_openmp(1), made once and given to morph and
!               adjoint, saves their question to the processor, up to 15 microseconds a call on a virtual machine.
! Parts         Codes on several processes: share_of, init_share, extract, pack, unpack, adjoint_scale, _sums, _finish,
!               see harmorph.h; harmorph_mpi.f90 does it with MPI. Meshes that no process
!               has as a whole: type(hm_part), which harmorph_petsc.f90 uses.
module harmorph
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_f_procpointer, c_float, &
        c_funloc, c_funptr, c_int8_t, c_int32_t, c_int64_t, c_intptr_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, &
        c_ptr, c_size_t, c_sizeof
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none
    private
