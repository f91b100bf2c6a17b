# find_package(harmorph): the target harmorph::harmorph, and harmorph_FORTRAN_DIR where the Fortran source lies.
# Relocatable: everything is found from where this file lies, lib*/cmake/harmorph below the prefix.
get_filename_component(_harmorph_prefix "${CMAKE_CURRENT_LIST_DIR}" PATH)
while(NOT EXISTS "${_harmorph_prefix}/include/harmorph.h")
    get_filename_component(_harmorph_above "${_harmorph_prefix}" PATH)
    if(_harmorph_above STREQUAL _harmorph_prefix)
        set(harmorph_FOUND FALSE)
        set(harmorph_NOT_FOUND_MESSAGE "include/harmorph.h is nowhere above ${CMAKE_CURRENT_LIST_DIR}")
        return()
    endif()
    set(_harmorph_prefix "${_harmorph_above}")
endwhile()

get_filename_component(_harmorph_library "${CMAKE_CURRENT_LIST_DIR}/../../libharmorph.a" ABSOLUTE)
if(NOT TARGET harmorph::harmorph)
    add_library(harmorph::harmorph STATIC IMPORTED)
    set_target_properties(harmorph::harmorph PROPERTIES
        IMPORTED_LOCATION "${_harmorph_library}"
        INTERFACE_INCLUDE_DIRECTORIES "${_harmorph_prefix}/include")
endif()
set(harmorph_FORTRAN_DIR "${_harmorph_prefix}/share/harmorph")
