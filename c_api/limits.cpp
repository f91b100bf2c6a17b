#include "limits.hpp"

namespace harmorph {

Status refuse_integer(Status why, const char* sentence, Index number, Item element,
                      Fault& fault) noexcept {
    if (element.kind == ItemKind::nothing) return fault.refuse(why, sentence, plain(number));
    return fault.refuse(why, sentence, element, plain(number));
}

Status refuse_size(const char* name, const char* type, Fault& fault) noexcept {
    return fault.refuse_arguments(name, type,
                                  "%.struct_size is not the size of an &; begin with HM_INIT(%)");
}

Status refuse_unknown_fields(const char* name, Fault& fault) noexcept {
    fault.refuse_argument(name,
                          "% contains fields that are set but unknown to this version of the "
                          "library; use the header of this version");
    return fault.status = Status::unsupported;
}

Status refuse_unknown_fields_of_element(Item item, const char* what, Fault& fault) noexcept {
    fault.refuse(Status::unsupported,
                 "% # contains fields that are set but unknown to this version of the library; use "
                 "the header of this version",
                 item);
    fault.argument = what;
    return fault.status;
}

Status refuse_size_of_element(Item item, const char* what, const char* type,
                              Fault& fault) noexcept {
    fault.refuse(Status::bad_argument,
                 "struct_size of % # is not the size of an &; begin with HM_INIT", item);
    fault.argument = what;
    fault.other_argument = type;
    return fault.status;
}

}  // namespace harmorph
