#pragma once
/// \file
/// All solid laws.

#include "ifsi/material/circumferential_fibre.hpp"
#include "ifsi/material/mooney_rivlin.hpp"
#include "ifsi/material/neo_hookean.hpp"
#include "ifsi/material/st_venant_kirchhoff.hpp"
#include "ifsi/material/tension_fibres.hpp"
#include "ifsi/material/thin_sheet.hpp"
#include "ifsi/material/uncoupled_neo_hookean.hpp"
#include "ifsi/material/yeoh.hpp"
