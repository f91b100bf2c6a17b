
! ---- Solved functions: the type; what it does is in the parts that follow --------------------------------------------

    type :: basis_counts                                        ! what the lengths of arrays are compared with
        integer(c_int64_t) :: points = 0, functions = 0, numbers = 1
    end type

    type, public :: hm_basis
        private
        type(c_ptr) :: handle = c_null_ptr
        type(block_of_memory) :: memory
        type(basis_counts) :: counts
        logical :: all_functions = .false.                      ! of all points: neither a share nor rows
    contains
        procedure :: init => basis_init
        procedure, private :: combine_real, combine_complex
        generic :: combine => combine_real, combine_complex
        procedure :: single => basis_single
        procedure :: single_words => basis_single_words
        procedure :: attach => basis_attach
        procedure :: address => basis_address
        procedure :: free => basis_free
        procedure, private :: basis_assign
        generic :: assignment(=) => basis_assign
        final :: basis_final
        ! Coordinates
!@each form
        procedure, private :: values_@FORM@, morph_@FORM@, morph_to_@FORM@, displacement_@FORM@, adjoint_@FORM@, &
            adjoint_scale_@FORM@, adjoint_sums_@FORM@, boundary_error_@FORM@, admissible_step_@FORM@, quality_@FORM@, &
            assess_@FORM@
        generic :: values => values_@FORM@
        generic :: morph => morph_@FORM@
        generic :: morph_to => morph_to_@FORM@
        generic :: displacement => displacement_@FORM@
        generic :: velocity => displacement_@FORM@
        generic :: adjoint => adjoint_@FORM@
        generic :: adjoint_scale => adjoint_scale_@FORM@
        generic :: adjoint_sums => adjoint_sums_@FORM@
        generic :: boundary_error => boundary_error_@FORM@
        generic :: admissible_step => admissible_step_@FORM@
        generic :: quality => quality_@FORM@
        generic :: assess => assess_@FORM@
!@end
        procedure :: morph_at => basis_morph_at
        procedure :: morph_mesh => basis_morph_mesh
        ! Files
        procedure :: write => basis_write
        procedure :: read => basis_read
        procedure :: save => basis_save
        procedure :: load => basis_load
        procedure :: bytes => basis_bytes
        ! What it was solved with
        procedure :: info => basis_info
        procedure :: curves => basis_curves
        procedure :: moved_curves => basis_moved_curves
        procedure :: conditions => basis_conditions
        ! Parts, for several processes
        procedure :: init_share => basis_init_share
        procedure :: extract => basis_extract
        procedure :: extract_words => basis_extract_words
        procedure :: pack => basis_pack
        procedure :: unpack => basis_unpack
        procedure :: parcel_words => basis_parcel_words
        procedure :: room => basis_room
        procedure :: take => basis_take
!@each real
        procedure, private :: adjoint_finish_@FORM@
        generic :: adjoint_finish => adjoint_finish_@FORM@
!@end
    end type

