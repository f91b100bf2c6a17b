# The version is read from the installed header, so that it stands in one place only. Same major version (before 1.0:
# same minor version) and not older: compatible.
set(_harmorph_dir "${CMAKE_CURRENT_LIST_DIR}")
while(NOT EXISTS "${_harmorph_dir}/include/harmorph.h")
    get_filename_component(_harmorph_above "${_harmorph_dir}" PATH)
    if(_harmorph_above STREQUAL _harmorph_dir)
        set(PACKAGE_VERSION_UNSUITABLE TRUE)
        return()
    endif()
    set(_harmorph_dir "${_harmorph_above}")
endwhile()

file(STRINGS "${_harmorph_dir}/include/harmorph.h" _harmorph_line REGEX "^#define HM_VERSION ")
string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1" PACKAGE_VERSION "${_harmorph_line}")
string(REGEX MATCH "^(0\\.[0-9]+|[1-9][0-9]*)" _harmorph_series "${PACKAGE_VERSION}")
string(REGEX MATCH "^(0\\.[0-9]+|[1-9][0-9]*)" _harmorph_wanted "${PACKAGE_FIND_VERSION}")
if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
elseif(NOT PACKAGE_FIND_VERSION OR (_harmorph_series STREQUAL _harmorph_wanted
                                    AND NOT PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION))
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
