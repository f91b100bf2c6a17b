# Never run: there is no vcpkg on the machine where harmorph is tested. Use this folder as an overlay port; the tarball
# of `make dist` lies in the folder downloads of vcpkg, where the name is found before any address.
vcpkg_check_linkage(ONLY_STATIC_LIBRARY)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${DOWNLOADS}/harmorph-${VERSION}.tar.gz")
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS -DBUILD_TESTING=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/harmorph)
vcpkg_copy_tools(TOOL_NAMES harmorph AUTO_CLEAN)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
