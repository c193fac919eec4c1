// How the names of the standard's API are exported: from a static library, nothing is to be said.
#pragma once

#define RTI_EXPORT
#define RTI_EXPORT_FEDTIME
