(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The text of a certificate, line by line, in words; integers in their only spelling. *)

(* Number of the line, and the problem. *)
exception Bad of int * string

type source = { text : string; mutable at : int; mutable line : int }

let bad s = Printf.ksprintf (fun message -> raise (Bad (s.line, message)))

let next s =
  s.line <- s.line + 1;
  match String.index_from_opt s.text s.at '\n' with
  | None when s.at < String.length s.text -> bad s "the line does not end"
  | None -> bad s "the certificate ends before the line \"end\""
  | Some k ->
    let line = String.sub s.text s.at (k - s.at) in
    s.at <- k + 1;
    line

let words s =
  let found = String.split_on_char ' ' (next s) in
  if List.mem "" found then bad s "two blanks, or a blank at the end or the beginning" else found

(* ---- numbers ---- *)

let after text k = String.sub text k (String.length text - k)

let integer s text =
  let digits = if String.starts_with ~prefix:"-" text then after text 1 else text in
  let wrong c = c < '0' || c > '9' in
  if digits = "" || (digits.[0] = '0' && text <> "0") || String.exists wrong digits then bad s "%S is no integer" text
  else Z.of_string text

(* An integer below 2^62 in absolute value. *)
let small s text =
  let n = integer s text in
  if Z.fits_int n then Z.to_int n else bad s "%s is too large" text

let count s text =
  let n = small s text in
  if n < 0 then bad s "%s is no count" text else n

(* The line "NAME count", and as many rows. *)
let rows s name row =
  match words s with
  | [ word; number ] when word = name -> List.init (count s number) row
  | _ -> bad s "%S is missing" name

let in_order s last here =
  if compare here !last <= 0 then bad s "lines are not in order";
  last := here
