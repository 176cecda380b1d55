#include "operators/pictures/walk_kernel.h"

NEUMANN_WALK_KERNEL(neumann::SpecularContinuation)
