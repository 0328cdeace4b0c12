@banner@
//
@contract@
@parts@export function @function@(@parameters@) {
@body@}
