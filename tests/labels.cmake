# SPDX-License-Identifier: GPL-3.0-or-later
# Gives `tests` their `labels`; ctest reads this file after it has found the tests of a program. gtest_discover_tests
# accepts only one label. Tests labelled `slow` are series of meshes or glyphs that take ten seconds or more under sanitizers
# and cover no code that smaller tests do not; under sanitizers they run only with scripts/test --all.
string(JOIN "|" slow
  ConstrainedSolver.Solves
  Exact.NamesTheDroplet Exact.NearlyAHemisphere Exact.NewtonSteps Exact.RefusesMoreThan Exact.SteepCaps
  FluidPresets.NothingPops
  Grading.MeshesAreValid Grading.NumberOfTriangles
  Hanging.FallsBeyond
  LatticeCore.EveryEdge
  Morph.AreaChangesEvenly
  Multigrid.AutoFactorsIfIt
  Penetration.ExactFilm Penetration.KktHold Penetration.SolversAgree
  Sheet.AnglesAtSingle Sheet.Caps Sheet.Gravity Sheet.SaysWhereTheMean
  SheetFollow.ABead SheetLimits.
  Solvers.AgreeOnTheZoo
  Walk.IsTheFormulaOnASlope Walk.NeverLeavesTheSurface
  WholeFont.Sans WholeFont.Serif)
foreach(test IN LISTS tests)
  if(test MATCHES "^(${slow})")
    set_tests_properties(${test} PROPERTIES LABELS "${labels};slow")
  else()
    set_tests_properties(${test} PROPERTIES LABELS "${labels}")
  endif()
endforeach()
