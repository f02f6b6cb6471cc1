// Numbers that name things of one world; none is used for another thing later.

/** Names a body. */
export type BodyHandle = number & { readonly __body: unique symbol };
/** Names a joint. */
export type JointHandle = number & { readonly __joint: unique symbol };
/** Names an attachment. */
export type AttachmentHandle = number & { readonly __attachment: unique symbol };
/** Names a grab. */
export type GrabHandle = number & { readonly __grab: unique symbol };
