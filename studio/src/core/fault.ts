/** An error for people to read: what it is about, what is wrong, and what to do. */
export class Fault extends Error {
  readonly subject: string;
  readonly fault: string;
  readonly remedy: string;

  constructor(subject: string, fault: string, remedy: string) {
    super(`${subject}: ${fault}. ${remedy}`);
    this.name = "Fault";
    this.subject = subject;
    this.fault = fault;
    this.remedy = remedy;
  }
}

/** What did not come; it may come when it is asked for again. */
export class Absent extends Fault {}

/** Any thrown value as a fault; one that nobody foresaw says so and keeps its own words. */
export function faultOf(error: unknown): Fault {
  if (error instanceof Fault) return error;
  const words = error instanceof Error ? error.message : String(error);
  return new Fault(
    "Veduta studio",
    `something went wrong that the studio did not foresee (${words})`,
    "Reload the page. If it happens again, please report it with these words.",
  );
}
