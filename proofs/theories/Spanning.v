(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The minimum spanning trees of all choices, by lengths [MST-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical Wf_nat.
From Dyadel Require Import Plane Finite Distance Cells Nerve NearGraph.
Open Scope R_scope.

(* A path from a to b of pairs that have a property. *)
Inductive joined (N : nat) (E : nat -> nat -> Prop) : nat -> nat -> Prop :=
| joined_here a : joined N E a a
| joined_by a b c : (a < N)%nat -> (b < N)%nat -> E a b -> joined N E b c -> joined N E a c.

Lemma joined_weaken N (E F : nat -> nat -> Prop) a b :
  (forall x y, (x < N)%nat -> (y < N)%nat -> E x y -> F x y) -> joined N E a b -> joined N F a b.
Proof. intros H J. induction J as [a | a b c A B P _ IH]; [constructor |]. apply joined_by with b; auto. Qed.

Lemma joined_trans N E a b c : joined N E a b -> joined N E b c -> joined N E a c.
Proof. intros J K. induction J as [a | a x y A X P _ IH]; [exact K |]. apply joined_by with x; auto. Qed.

Lemma joined_by_paths N (E F : nat -> nat -> Prop) a b :
  (forall x y, (x < N)%nat -> (y < N)%nat -> E x y -> joined N F x y) -> joined N E a b -> joined N F a b.
Proof. intros H J. induction J as [a | a x y A X P _ IH]; [constructor | apply joined_trans with x; [now apply H | exact IH]]. Qed.

Lemma joined_sym N (E : nat -> nat -> Prop) a b : (forall x y, E x y -> E y x) -> joined N E a b -> joined N E b a.
Proof.
  intros S J. induction J as [a | a b c A C P _ IH]; [constructor |]. apply joined_trans with (1 := IH).
  apply joined_by with a; auto. constructor.
Qed.

(* ij is in a minimum spanning tree iff no path has strictly shorter pairs only; in every one, if no other path has pairs
   of at most its length. *)
Definition other (i j a b : nat) : Prop := ~ ((a = i /\ b = j) \/ (a = j /\ b = i)).
Definition in_tree (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  ~ joined N (fun a b => dist (p a) (p b) < dist (p i) (p j)) i j.
Definition in_all_trees (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  ~ joined N (fun a b => other i j a b /\ dist (p a) (p b) <= dist (p i) (p j)) i j.

(* Bounds of the lengths. *)
Definition lengths (N : nat) (B : sites) (lo hi : nat -> nat -> R) : Prop := forall a b x y, (a < N)%nat -> (b < N)%nat ->
  inside x (B a) -> inside y (B b) -> lo a b <= dist x y <= hi a b.

(* Never: a path of pairs that are always shorter, ... *)
Theorem never_by_path N B lo hi (S : nat -> nat -> Prop) i j p : lengths N B lo hi -> (i < N)%nat -> (j < N)%nat ->
  joined N (fun a b => S a b /\ hi a b < lo i j) i j -> choice N B p -> ~ in_tree N p i j.
Proof.
  intros L I J H P T. apply T. revert H. apply joined_weaken. intros a b A C [_ Q].
  pose proof (L a b _ _ A C (P a A) (P b C)). pose proof (L i j _ _ I J (P i I) (P j J)). lra.
Qed.

(* ... or a site strictly inside the disc with the pair as its diameter. *)
Lemma inside_disc_shorter a b z : (fst z - fst a) * (fst z - fst b) + (snd z - snd a) * (snd z - snd b) < 0 ->
  dist a z < dist a b /\ dist z b < dist a b.
Proof.
  intros H. assert (E : dist2 a b = dist2 a z + dist2 z b - 2 * ((fst z - fst a) * (fst z - fst b) +
    (snd z - snd a) * (snd z - snd b))) by (unfold dist2; ring).
  pose proof (dist2_nonneg a z). pose proof (dist2_nonneg z b). split; apply dist_lt; lra.
Qed.

Theorem never_inside N p i j k : (i < N)%nat -> (j < N)%nat -> (k < N)%nat ->
  (fst (p k) - fst (p i)) * (fst (p k) - fst (p j)) + (snd (p k) - snd (p i)) * (snd (p k) - snd (p j)) < 0 ->
  ~ in_tree N p i j.
Proof.
  intros I J K H T. destruct (inside_disc_shorter _ _ _ H) as [A C]. apply T.
  apply joined_by with k; try assumption. apply joined_by with j; try assumption. constructor.
Qed.

(* Every pair is joined by possible pairs, other than ij, that are no longer than it; induction on how many pairs are
   shorter. *)
Fixpoint count (f : nat -> bool) (n : nat) : nat := match n with 0%nat => 0%nat | S m => ((if f m then 1 else 0) + count f m)%nat end.

Lemma count_less f g n m : (forall k, f k = true -> g k = true) -> (m < n)%nat -> f m = false -> g m = true ->
  (count f n < count g n)%nat.
Proof.
  intros H. assert (Le : forall n, (count f n <= count g n)%nat).
  { induction n0 as [| n0 IH]; simpl; [lia |]. pose proof (H n0) as Q.
    destruct (f n0); destruct (g n0); try lia; discriminate (Q eq_refl). }
  induction n as [| n IH]; intros M F G; [lia |]. simpl. destruct (Nat.eq_dec m n) as [-> | D].
  - rewrite F, G. specialize (Le n). lia.
  - assert ((m < n)%nat) as M' by lia. specialize (IH M' F G). pose proof (H n) as Q.
    destruct (f n); destruct (g n); try lia; discriminate (Q eq_refl).
Qed.

(* How many pairs are shorter: pair a b has the number a N + b. *)
Definition shorter (N : nat) (p : nat -> point) (l : R) (m : nat) : bool :=
  if Rlt_dec (dist (p (m / N)%nat) (p (m mod N)%nat)) l then true else false.

Lemma shorter_less N p a b c d : (a < N)%nat -> (b < N)%nat -> dist (p a) (p b) < dist (p c) (p d) ->
  (count (shorter N p (dist (p a) (p b))) (N * N) < count (shorter N p (dist (p c) (p d))) (N * N))%nat.
Proof.
  intros A C L. assert (E1 : ((a * N + b) / N = a)%nat) by (rewrite Nat.div_add_l, Nat.div_small; lia).
  assert (E2 : ((a * N + b) mod N = b)%nat) by (rewrite Nat.add_comm, Nat.mod_add, Nat.mod_small; lia).
  apply count_less with (m := (a * N + b)%nat).
  - intros k. unfold shorter. destruct (Rlt_dec _ (dist (p a) (p b))); [| discriminate].
    destruct (Rlt_dec _ (dist (p c) (p d))); [reflexivity | lra].
  - nia.
  - unfold shorter. rewrite E1, E2. destruct (Rlt_dec _ _); [lra | reflexivity].
  - unfold shorter. rewrite E1, E2. destruct (Rlt_dec _ _); [reflexivity | lra].
Qed.

Lemma possible_path N B p l : choice N B p -> forall a b, (a < N)%nat -> (b < N)%nat -> dist (p a) (p b) <= l ->
  joined N (fun x y => (possible N B x y /\ in_tree N p x y) /\ (x = a /\ y = b \/ dist (p x) (p y) < dist (p a) (p b))) a b.
Proof.
  intros P a b. remember (count (shorter N p (dist (p a) (p b))) (N * N)) as n eqn:En. revert a b En.
  induction n as [n IH] using lt_wf_ind. intros a b En A C L.
  destruct (classic (joined N (fun x y => dist (p x) (p y) < dist (p a) (p b)) a b)) as [J | T].
  - assert (W : forall x y, (x < N)%nat -> (y < N)%nat -> dist (p x) (p y) < dist (p a) (p b) ->
      joined N (fun x y => (possible N B x y /\ in_tree N p x y) /\ (x = a /\ y = b \/ dist (p x) (p y) < dist (p a) (p b))) x y).
    { intros x y X Y Q.
      assert (Le : (count (shorter N p (dist (p x) (p y))) (N * N) < n)%nat) by (rewrite En; now apply shorter_less).
      assert (Lq : dist (p x) (p y) <= l) by lra.
      apply joined_weaken with (2 := IH _ Le x y eq_refl X Y Lq).
      intros u v _ _ [Po [[-> ->] | S]]; split; try exact Po; right; lra. }
    revert J. now apply joined_by_paths.
  - apply joined_by with b; try assumption; [| constructor]. split; [| left; now split]. split; [| exact T].
    apply (disc_possible N B p a b (mix (/ 2) (p a) (p b)) (dist (p a) (p b) / 2) A C P). split.
    + intros k _ [-> | ->].
      * rewrite (dist_sym (mix _ _ _)), dist_mix_left by lra. lra.
      * rewrite dist_mix_right by lra. lra.
    + intros k K. pose proof (dist_nonneg (p a) (p b)). apply le_of_squares; [apply dist_nonneg |].
      rewrite dist_sq. replace (dist (p a) (p b) / 2 * (dist (p a) (p b) / 2)) with (dist2 (p a) (p b) / 4)
        by (rewrite <- dist_sq; field).
      apply Rnot_lt_le. intros Q. apply (never_inside N p a b k A C K); [| exact T].
      assert (E : dist2 (mix (/ 2) (p a) (p b)) (p k) = dist2 (p a) (p b) / 4 +
        ((fst (p k) - fst (p a)) * (fst (p k) - fst (p b)) + (snd (p k) - snd (p a)) * (snd (p k) - snd (p b))))
        by (unfold dist2, mix; simpl; field). lra.
Qed.

(* M: the pairs that are not known to be in no tree. *)
Definition may_be_in (N : nat) (B : sites) (M : nat -> nat -> Prop) : Prop := forall p a b, choice N B p ->
  (a < N)%nat -> (b < N)%nat -> possible N B a b -> in_tree N p a b -> M a b.

(* Surely: those other than ij that may be as short do not join i and j; *)
Theorem surely_by_cut N B M lo hi i j : lengths N B lo hi -> may_be_in N B M -> (i < N)%nat -> (j < N)%nat ->
  ~ joined N (fun a b => other i j a b /\ M a b /\ lo a b <= hi i j) i j ->
  forall p, choice N B p -> in_all_trees N p i j.
Proof.
  intros L May I J H p P T. apply H.
  assert (G : forall a b, joined N (fun a b => other i j a b /\ dist (p a) (p b) <= dist (p i) (p j)) a b ->
    joined N (fun a b => other i j a b /\ M a b /\ lo a b <= hi i j) a b); [| now apply G].
  intros a b. apply joined_by_paths. clear a b. intros a b A C [O S].
  apply joined_weaken with (2 := possible_path N B p _ P a b A C (Rle_refl _)).
  intros x y X Y [[Po Tr] D]. pose proof (May p x y P X Y Po Tr) as Mxy. pose proof (L x y _ _ X Y (P x X) (P y Y)). pose proof (L i j _ _ I J (P i I) (P j J)).
  destruct D as [[-> ->] | D]; (split; [| split; [exact Mxy | lra]]); [exact O |].
  intros [[-> ->] | [-> ->]]; [lra |]. rewrite (dist_sym (p j) (p i)) in D. lra.
Qed.

(* or j is surely the only nearest one to i. *)
Lemma first_step N E i j : joined N E i j -> i <> j -> exists k, (k < N)%nat /\ k <> i /\ E i k.
Proof.
  intros H. induction H as [a | a b c A C P _ IH]; intros D; [congruence |].
  destruct (Nat.eq_dec b a) as [-> | Db]; [now apply IH |]. now exists b.
Qed.

Theorem surely_by_nearest N B i j : (i < N)%nat -> (j < N)%nat -> i <> j -> surely_is_nearest N B i j ->
  forall p, choice N B p -> in_all_trees N p i j.
Proof.
  intros I J D H p P T. destruct (first_step _ _ _ _ T D) as [k [K [Dk [O S]]]].
  destruct (Nat.eq_dec k j) as [-> | Dj]; [apply O; now left |]. pose proof (H p P k K Dk Dj). lra.
Qed.

Theorem in_all_trees_sym N p i j : in_all_trees N p i j -> in_all_trees N p j i.
Proof.
  intros H T. apply H. apply joined_sym.
  - intros x y [O L]. split; [unfold other in *; tauto | now rewrite (dist_sym (p y))].
  - revert T. apply joined_weaken. intros a b _ _ [O L]. split; [unfold other in *; tauto |].
    now rewrite (dist_sym (p i)).
Qed.

(* In all trees is more than in one; both statuses stay when there is more information. *)
Theorem in_all_is_in_one N p i j : i <> j -> in_all_trees N p i j -> in_tree N p i j.
Proof.
  intros D H T. apply H. revert T. apply joined_weaken. intros a b _ _ S. split; [| lra].
  intros [[-> ->] | [-> ->]]; [lra |]. rewrite (dist_sym (p j) (p i)) in S. lra.
Qed.

Theorem cut_monotone N (M M' : nat -> nat -> Prop) lo hi lo' hi' i j : (i < N)%nat -> (j < N)%nat ->
  (forall a b, (a < N)%nat -> (b < N)%nat -> M' a b -> M a b) ->
  (forall a b, (a < N)%nat -> (b < N)%nat -> lo a b <= lo' a b /\ hi' a b <= hi a b) ->
  ~ joined N (fun a b => other i j a b /\ M a b /\ lo a b <= hi i j) i j ->
  ~ joined N (fun a b => other i j a b /\ M' a b /\ lo' a b <= hi' i j) i j.
Proof.
  intros I J F Le H T. apply H. revert T. apply joined_weaken. intros a b A C [O [P L]]. split; [exact O |].
  split; [now apply F |]. destruct (Le a b A C). destruct (Le i j I J). lra.
Qed.

Theorem path_monotone N (S S' : nat -> nat -> Prop) lo hi lo' hi' i j : (i < N)%nat -> (j < N)%nat ->
  (forall a b, (a < N)%nat -> (b < N)%nat -> S a b -> S' a b) ->
  (forall a b, (a < N)%nat -> (b < N)%nat -> lo a b <= lo' a b /\ hi' a b <= hi a b) ->
  joined N (fun a b => S a b /\ hi a b < lo i j) i j -> joined N (fun a b => S' a b /\ hi' a b < lo' i j) i j.
Proof.
  intros I J F M. apply joined_weaken. intros a b A C [Sa L]. split; [now apply F |].
  destruct (M a b A C). destruct (M i j I J). lra.
Qed.
