// The C interface: versions, names of statuses, initialisation of structs.
#include "harmorph.h"

#include <cstring>

extern "C" {

int32_t hm_abi_version(void) { return HM_ABI; }
const char* hm_version(void) { return HM_VERSION; }

void hm_init(void* any_struct, uint64_t size) {
    if (any_struct == nullptr || size < sizeof size) return;
    std::memset(any_struct, 0, static_cast<size_t>(size));
    std::memcpy(any_struct, &size, sizeof size);
}

const char* hm_status_name(hm_status status) {
    switch (status) {
        case HM_OK: return "HM_OK";
        case HM_NOT_CONVERGED: return "HM_NOT_CONVERGED";
        case HM_MOVED: return "HM_MOVED";
        case HM_SHORT: return "HM_SHORT";
        case HM_BACKTRACKS: return "HM_BACKTRACKS";
        case HM_TORN: return "HM_TORN";
        case HM_FAR_FROM_CURVE: return "HM_FAR_FROM_CURVE";
        case HM_FAR_FROM_POINTS: return "HM_FAR_FROM_POINTS";
        case HM_POOR: return "HM_POOR";
        case HM_CANCELLED: return "HM_CANCELLED";
        case HM_BAD_ARGUMENT: return "HM_BAD_ARGUMENT";
        case HM_BAD_MESH: return "HM_BAD_MESH";
        case HM_BAD_CURVE: return "HM_BAD_CURVE";
        case HM_BAD_CONDITION: return "HM_BAD_CONDITION";
        case HM_BAD_BASIS: return "HM_BAD_BASIS";
        case HM_BLOCK_TOO_SMALL: return "HM_BLOCK_TOO_SMALL";
        case HM_NOT_POSITIVE: return "HM_NOT_POSITIVE";
        case HM_UNSUPPORTED: return "HM_UNSUPPORTED";
        case HM_CROSSING: return "HM_CROSSING";
        default: return "unknown status";
    }
}

}  // extern "C"
