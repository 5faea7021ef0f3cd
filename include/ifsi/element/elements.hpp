#pragma once
/// \file
/// All reference elements.

#include "ifsi/element/hex.hpp"
#include "ifsi/element/line.hpp"
#include "ifsi/element/point.hpp"
#include "ifsi/element/quad.hpp"
#include "ifsi/element/tet.hpp"
#include "ifsi/element/triangle.hpp"
#include "ifsi/element/wedge.hpp"
