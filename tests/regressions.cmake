# SPDX-License-Identifier: LGPL-2.1-or-later
# Included by the folder of each program: its regressions run that program.
get_filename_component(TEST_TARGET ${CMAKE_CURRENT_SOURCE_DIR} NAME)
deal_ii_pickup_tests()
get_property(regressions DIRECTORY PROPERTY TESTS)
if(regressions)
  set_tests_properties(${regressions} PROPERTIES
    ENVIRONMENT "${TEST_ENVIRONMENT}" RESOURCE_LOCK build_tool LABELS quick)
endif()
