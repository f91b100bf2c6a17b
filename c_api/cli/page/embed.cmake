# What embed.sh does, for CMake: ${PROJECT_BINARY_DIR}/page_text.cpp.
set(page_parts ${CMAKE_CURRENT_LIST_DIR})
file(GLOB page_files CONFIGURE_DEPENDS ${page_parts}/*.html ${page_parts}/*.css ${page_parts}/*.js)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_files})
file(READ ${page_parts}/page.html page_text)
foreach(path IN LISTS page_files)
    get_filename_component(name ${path} NAME)
    file(READ ${path} text)
    # A literal of its own for each file: compilers limit them.
    set(inside ")page\"\nR\"page(${text})page\"\nR\"page(")
    string(REPLACE "<script src=\"${name}\"></script>\n" "<script>\n${inside}</script>\n" page_text "${page_text}")
    string(REPLACE "<link href=\"${name}\" rel=\"stylesheet\">\n" "<style>\n${inside}</style>\n" page_text "${page_text}")
endforeach()
string(REPLACE "<script src=\"data.js\"></script>\n" ")page\";\n\nconst char* const cli::page_after_data =\nR\"page("
    page_text "${page_text}")
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/page_text.cpp CONTENT "#include \"cli/page_text.hpp\"

const char* const cli::page_before_data =
R\"page(${page_text})page\";
")
