
    ! ---- Communicators: a handle of mpi_f08, or the number of older interfaces ----------------------------------

    interface number_of
        procedure :: number_of_handle, number_of_number
    end interface

contains

    pure integer(c_int) function number_of_handle(comm)
        type(mpi_comm), intent(in) :: comm
        number_of_handle = int(comm%mpi_val, c_int)
    end function

    pure integer(c_int) function number_of_number(comm)
        integer, intent(in) :: comm
        number_of_number = int(comm, c_int)
    end function
