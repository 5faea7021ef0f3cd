#pragma once
/// \file
/// For templates over elements that are compiled once, in src/instantiate: the elements they are compiled
/// for. Others work all the same; they are compiled where they are used.

#include "ifsi/element/elements.hpp"

/// apply(Element, ...) for every element that cells of a mesh may have.
#define IFSI_FOR_EACH_CELL(apply, ...)         \
  IFSI_FOR_EACH_LINE_CELL(apply, __VA_ARGS__)  \
  IFSI_FOR_EACH_PLANE_CELL(apply, __VA_ARGS__) \
  IFSI_FOR_EACH_SPACE_CELL(apply, __VA_ARGS__)

#define IFSI_FOR_EACH_LINE_CELL(apply, ...) apply(Line1, __VA_ARGS__) apply(Line2, __VA_ARGS__)

#define IFSI_FOR_EACH_PLANE_CELL(apply, ...) \
  apply(Tri1, __VA_ARGS__) apply(Tri2, __VA_ARGS__) apply(Quad1, __VA_ARGS__) apply(Quad2, __VA_ARGS__)

#define IFSI_FOR_EACH_SPACE_CELL(apply, ...)                                                          \
  apply(Tet1, __VA_ARGS__) apply(Tet2, __VA_ARGS__) apply(Hex1, __VA_ARGS__) apply(Hex2, __VA_ARGS__) \
      apply(Wedge1, __VA_ARGS__)
