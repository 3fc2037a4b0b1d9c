(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Neither the number of programs that answer, nor the times of requests and answers changes the answers [ORA-2]. *)
From Coq Require Import ZArith Arith List Lia.
Import ListNotations.

Section Jobs.
(* The answer of a program on a point: given the bits requested now, and the bits requested of it before. *)
Variables (answer : Type) (reply : nat -> Z -> list Z -> answer).
Definition request : Type := (nat * Z)%type.
Definition told : Type := list (request * answer).

(* The next request of the engine, given all answers that it has. *)
Variable next : told -> option request.

Definition former (i : nat) (l : list request) : list Z := map snd (filter (fun r => fst r =? i) l).

(* What a program prints for the requests it has read, after others. *)
Fixpoint printed (before l : list request) : list answer :=
  match l with
  | [] => []
  | r :: rest => reply (fst r) (snd r) (former (fst r) before) :: printed (before ++ [r]) rest
  end.

(* Requests go to the program of their point. A state: the answers of the engine, the requests sent to each program, and
   how many answers of each were taken. Requests are sent ahead at any time; an answer is taken when it has come and its
   request is the one that the engine makes. *)
Variable job : nat -> nat.
Inductive runs : told -> (nat -> list request) -> (nat -> nat) -> Prop :=
| runs_begin : runs [] (fun _ => []) (fun _ => 0)
| runs_send h sent taken r : runs h sent taken ->
    runs h (fun k => if k =? job (fst r) then sent k ++ [r] else sent k) taken
| runs_take h sent taken r a : runs h sent taken -> next h = Some r ->
    nth_error (sent (job (fst r))) (taken (job (fst r))) = Some r ->
    nth_error (printed [] (sent (job (fst r)))) (taken (job (fst r))) = Some a ->
    runs (h ++ [(r, a)]) sent (fun k => if k =? job (fst r) then S (taken k) else taken k).

Lemma printed_nth l : forall before n r, nth_error l n = Some r ->
  nth_error (printed before l) n = Some (reply (fst r) (snd r) (former (fst r) (before ++ firstn n l))).
Proof.
  induction l as [| x l IH]; intros before n r H; [now destruct n |]. destruct n as [| n]; simpl in *.
  - injection H as ->. now rewrite app_nil_r.
  - rewrite (IH _ _ _ H), <- app_assoc. reflexivity.
Qed.

Lemma firstn_next {A} (l : list A) : forall n x, nth_error l n = Some x -> firstn (S n) l = firstn n l ++ [x].
Proof.
  induction l as [| y l IH]; intros n x H; [now destruct n |]. destruct n as [| n]; simpl in *; [congruence |].
  f_equal. now apply IH.
Qed.

Lemma nth_below {A} (l : list A) n x : nth_error l n = Some x -> n < length l.
Proof. intros H. apply nth_error_Some. congruence. Qed.

(* The answers taken from a program are those to what the engine asked of it, in that order. *)
Lemma in_order h sent taken : runs h sent taken -> forall k, taken k <= length (sent k) /\
  firstn (taken k) (sent k) = filter (fun r => job (fst r) =? k) (map fst h).
Proof.
  intros R. induction R as [| h sent taken r R IH | h sent taken r a R IH Nx Q A]; intros k; [now split | |].
  - destruct (IH k) as [L E]. destruct (Nat.eqb_spec k (job (fst r))); [| now split]. rewrite app_length.
    split; [lia |].
    rewrite firstn_app. replace (taken k - length (sent k)) with 0 by lia. simpl. now rewrite app_nil_r.
  - destruct (IH k) as [L E]. rewrite map_app, filter_app. simpl. rewrite (Nat.eqb_sym (job (fst r)) k).
    destruct (Nat.eqb_spec k (job (fst r))) as [-> | D]; [| rewrite app_nil_r; now split].
    split; [now apply nth_below in Q |]. now rewrite (firstn_next _ _ _ Q), E.
Qed.

Lemma former_of_program i l : former i (filter (fun r => job (fst r) =? job i) l) = former i l.
Proof.
  unfold former. f_equal. induction l as [| r l IH]; [reflexivity |]. simpl.
  destruct (Nat.eqb_spec (job (fst r)) (job i)) as [E | E]; simpl; [now rewrite IH |].
  rewrite IH. destruct (Nat.eqb_spec (fst r) i) as [Q | D]; [elim E; now rewrite Q | reflexivity].
Qed.

(* The answers of one program that gets one request at a time. *)
Inductive alone : told -> Prop :=
| alone_begin : alone []
| alone_next h r : alone h -> next h = Some r -> alone (h ++ [(r, reply (fst r) (snd r) (former (fst r) (map fst h)))]).

Theorem runs_alone h sent taken : runs h sent taken -> alone h.
Proof.
  intros R. induction R as [| h sent taken r R IH | h sent taken r a R IH Nx Q A]; [constructor | exact IH |].
  rewrite (printed_nth _ [] _ _ Q) in A. injection A as <-. simpl.
  destruct (in_order _ _ _ R (job (fst r))) as [_ E]. rewrite E, former_of_program. now apply alone_next.
Qed.

Lemma alone_same h : alone h -> forall g, alone g -> length g = length h -> g = h.
Proof.
  intros A. induction A as [| h r A IH N]; intros g G L.
  - now destruct g.
  - destruct G as [| g s G M]; rewrite !app_length in L; simpl in L; [lia |].
    assert (E : g = h) by (apply IH; [exact G | lia]). subst g. rewrite N in M. now injection M as <-.
Qed.
End Jobs.

(* Two runs with any numbers of programs, any requests sent ahead, and answers at any time: when as many answers were
   taken, they are the same ones. *)
Theorem runs_same answer reply next job job' h sent taken h' sent' taken' :
  runs answer reply next job h sent taken -> runs answer reply next job' h' sent' taken' ->
  length h = length h' -> h = h'.
Proof.
  intros R R' L. apply (alone_same answer reply next h'); [| | exact L].
  now apply (runs_alone _ _ _ job' h' sent' taken').
  now apply (runs_alone _ _ _ job h sent taken).
Qed.

(* And both end together: every run to the end has taken the same answers. *)
Theorem ends_same answer reply next job job' h sent taken h' sent' taken' :
  runs answer reply next job h sent taken -> runs answer reply next job' h' sent' taken' ->
  next h = None -> next h' = None -> h = h'.
Proof.
  intros R R' E E'.
  assert (K : forall g, alone answer reply next g -> forall n, n <= length g -> alone answer reply next (firstn n g) /\
    (n < length g -> exists r, next (firstn n g) = Some r)).
  { intros g G. induction G as [| g r G IH N]; intros n L.
    - simpl in L. replace n with 0 by lia. split; [constructor | simpl; lia].
    - rewrite app_length in L |- *. simpl in L |- *. rewrite firstn_app.
      destruct (Nat.leb_spec n (length g)) as [B | B].
      + replace (n - length g) with 0 by lia. simpl. rewrite app_nil_r. destruct (IH n B) as [X Y]. split; [exact X |].
        intros _. destruct (Nat.eq_dec n (length g)) as [-> | D]; [rewrite firstn_all; now exists r | apply Y; lia].
      + replace (n - length g) with 1 by lia. rewrite firstn_all2 by lia. simpl. split; [| lia]. now apply alone_next. }
  pose proof (runs_alone _ _ _ _ _ _ _ R) as A. pose proof (runs_alone _ _ _ _ _ _ _ R') as A'.
  assert (Le : forall g g', alone answer reply next g -> alone answer reply next g' -> next g = None ->
    length g' <= length g).
  { intros g g' G G' N. destruct (Nat.leb_spec (length g') (length g)) as [B | B]; [exact B | exfalso].
    destruct (K g' G' (length g) ltac:(lia)) as [X Y]. destruct (Y B) as [r Z].
    assert (Q : firstn (length g) g' = g).
    { apply (alone_same answer reply next g G); [exact X |]. rewrite firstn_length. lia. }
    rewrite Q in Z. congruence. }
  apply (alone_same answer reply next h' A' h A). pose proof (Le h h' A A' E). pose proof (Le h' h A' A E'). lia.
Qed.
