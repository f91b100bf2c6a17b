// Numbers in the memory of the module, which calls read and write without a copy.
import { disposable, Owner } from "./library.js";
import { refuse, whole } from "./errors.js";

/** An array of n numbers, 0 at first. */
export class Numbers extends Owner {
    constructor(n) {
        super();
        this.length = whole(n, "The number of numbers", 0);
        this.scope = this.own();
        this.address = this.scope.take(8 * n);
        this.view.fill(0);
    }

    /** The numbers: a view of the memory. Take the view again after calls, as the memory may grow. */
    get view() {
        if (this.scope === null) refuse("These numbers were freed.");
        return this.library.memory.numbers(this.address, this.length);
    }

    free() {
        this.scope = this.disown(this.scope);
    }
}
disposable(Numbers);
