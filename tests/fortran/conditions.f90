! Conditions: rigid bodies, periodic pairs, sides that slip.
module conditions_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t
    use body_mesh
    implicit none
    private
    public :: conditions

contains

    ! A rigid hole in a channel; left and right are a periodic pair, the ceiling slips, the floor is fixed.
    subroutine conditions()
        real(dp), target :: cx(231), cy(231)
        integer(c_int32_t), target :: channel_cells(4, 200), channel_faces(2, 100), channel_markers(100)
        type(hm_mesh) :: channel
        type(hm_plan) :: plan
        type(hm_basis) :: own, again
        type(hm_basis_info) :: info
        type(hm_condition), allocatable :: known(:)
        type(hm_curves) :: none
        real(dp) :: move(2, 2), dx(231), dy(231), c, s, value(231), angle, dense(2, 231, 4)
        integer :: cell_count, face_count, k
        integer, allocatable :: hole(:), below(:), above(:), left(:), right(:)
        integer :: stat
        call make_channel(cx, cy, channel_cells, cell_count, channel_faces, channel_markers, face_count)
        call channel%points(cx, cy)
        call channel%cells(channel_cells(:, :cell_count))
        call channel%faces(channel_faces(:, :face_count), channel_markers(:face_count))
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid, x=10._dp, y=5._dp), hm_condition(3, hm_slip), &
            hm_condition(4, hm_periodic_pair, partner=2)])
        call plan%boundary([5], hole)
        call plan%boundary([1], below)
        call plan%boundary([2], right)
        call plan%boundary([3], above)
        call plan%boundary([4], left)
        call plan%factor()
        call plan%solve(own)
        call own%info(info)
        call check(info%bodies == 1 .and. info%functions == 2 .and. info%curves == 0 .and. &
            info%numbers_per_value == 4, "a rigid body without curves")
        call check(size(info%curve_point) == 12 .and. all(info%point_curve == 1), "its points")
        call own%curves(none)
        call check(size(none%control, 2) == 0 .and. size(none%curve) == 0, "no curves to be had")

        c = cos(0.3_dp) - 1
        s = sin(0.3_dp)
        move = reshape([0.4_dp, 0.2_dp, c, s], [2, 2])
        call own%displacement(move, dx, dy)
        call check(all(abs(dx(hole) - (0.4_dp + c * (cx(hole) - 10) - s * (cy(hole) - 5))) < 1e-14_dp) .and. &
            all(abs(dy(hole) - (0.2_dp + s * (cx(hole) - 10) + c * (cy(hole) - 5))) < 1e-14_dp), &
            "the body moves rigidly")
        call own%matrix(dense)
        call check(maxval(abs(matmul(move(1, :), dense(:, :, 1)) + &
                   matmul(move(2, :), dense(:, :, 2)) - dx)) < 1e-14_dp, &
            "the x of the movement are products with the dense functions")
        call check(maxval(abs(matmul(move(1, :), dense(:, :, 3)) + &
                   matmul(move(2, :), dense(:, :, 4)) - dy)) < 1e-14_dp, &
            "products with the dense functions are the displacements")
        call own%matrix(dense(:, :, :3), stat)
        call check(stat == hm_bad_argument, "a dense array of another shape")
        call check(all(abs(dx(below)) <= 0) .and. all(abs(dy(below)) <= 0), "the floor stays")
        call check(all(abs(dy(above)) <= 0) .and. maxval(abs(dx(above))) > 1e-3_dp, "the ceiling slips")
        call check(same(dx(left), dx(right(size(right):1:-1))) .and. same(dy(left), dy(right(size(right):1:-1))) .and. &
            maxval(abs(dx(left))) > 1e-3_dp, "left and right move alike")

        call own%conditions(known)
        call check(size(known) == 3, "three conditions are known")
        call check(known(1)%kind == hm_rigid .and. known(1)%body == 1 .and. abs(known(1)%x - 10) + abs(known(1)%y - &
            5) <= 0 .and. known(2)%kind == hm_slip .and. known(2)%marker == 3 .and. known(3)%partner == 2, &
            "as they were given")
        call plan%analyse(channel, conditions=known)
        call plan%factor()
        call plan%solve(again)
        do k = 1, 4
            call own%values(2, dx, number=k)
            call again%values(2, value, number=k)
            call check(same(dx, value), "the same conditions, the same functions")
        end do
        call again%free()
        call again%conditions(known, stat)
        call check(stat == hm_bad_argument, "an empty basis has no conditions")
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid, body=2)], stat=stat)
        call check(stat == hm_bad_condition, "bodies count without gaps")
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid), hm_condition(1, hm_free)], stat=stat)
        call check(stat == hm_unsupported, "free sides are not for conformal functions")
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid), &
            hm_condition(4, hm_periodic_pair, partner=3)], stat=stat)
        call check(stat == hm_bad_condition, "no pair")

        ! Bent round (1, 2), the right side is the left one, turned by an angle.
        angle = 0.5_dp
        do k = 1, size(cx)
            c = angle * cx(k) / 20
            s = 30 - cy(k)
            cx(k) = 1 + s * cos(c)
            cy(k) = 2 + s * sin(c)
        end do
        call channel%points(cx, cy)
        call channel%cells(channel_cells(:, :cell_count))
        call channel%faces(channel_faces(:, :face_count), channel_markers(:face_count))
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid, x=30._dp, y=5._dp), &
            hm_condition(4, hm_rotation_pair, partner=2, x=1._dp, y=2._dp)])
        call plan%factor()
        call plan%solve(own)
        call own%displacement(move, dx, dy)
        right = right(size(right):1:-1)
        call check(all(abs(cos(angle) * dx(left) - sin(angle) * dy(left) - dx(right)) < 1e-14_dp) .and. &
            all(abs(sin(angle) * dx(left) + cos(angle) * dy(left) - dy(right)) < 1e-14_dp) .and. &
            maxval(abs(dx(left))) > 1e-3_dp, "the right side of a passage moves as the left one, turned")
        call own%conditions(known)
        call check(known(2)%kind == hm_rotation_pair .and. abs(known(2)%x - 1) + abs(known(2)%y - 2) <= 0, &
            "a rotation pair as it was given")
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid, x=30._dp, y=5._dp), &
            hm_condition(4, hm_interface, partner=2)])
        call plan%factor()
        call plan%solve(own)
        call own%conditions(known)
        call check(known(2)%kind == hm_interface .and. known(2)%marker == 4 .and. known(2)%partner == 2, &
            "an interface as it was given")
    end subroutine
end module
