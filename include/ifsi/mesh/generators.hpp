#pragma once
/// \file
/// All mesh generators.

#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/channel_with_cylinder.hpp"
#include "ifsi/mesh/elevate.hpp"
#include "ifsi/mesh/extrude.hpp"
#include "ifsi/mesh/pipe.hpp"
#include "ifsi/mesh/ring.hpp"
