(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Monotone chains, as dyd_polygon_make_convex goes along them: the polygon it makes of sorted points is in
   counterclockwise order as seen from its first vertex, so AreaVoronoi.v knows its area. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Dyadel Require Import Plane Orientation Measure AreaVoronoi.
Import ListNotations.
Open Scope R_scope.

(* By x, then by y. *)
Definition lex (p q : point) : Prop := fst p < fst q \/ (fst p = fst q /\ snd p <= snd q).

(* A chain with its last point first: extends it by z, removing each vertex that is not a left turn. *)
Fixpoint extend (z : point) (s : list point) : list point :=
  match s with
  | b :: ((a :: _) as r) => if Rle_dec (orient a b z) 0 then extend z r else z :: s
  | _ => z :: s
  end.
Definition chain (l : list point) : list point := fold_left (fun s z => extend z s) l [].

(* The lower chain, then the upper one without the two points that they share. *)
Definition convex_polygon (l : list point) : list point := rev (chain l) ++ tl (rev (tl (chain (rev l)))).

(* ---- what a chain is ---- *)

Fixpoint turns (s : list point) : Prop :=
  match s with c :: ((b :: a :: _) as r) => 0 < orient a b c /\ turns r | _ => True end.

Lemma extend_turns z s : turns s -> turns (extend z s).
Proof.
  induction s as [| b s IH]; [easy |]. destruct s as [| a s]; [easy |]. intros T. cbn [extend].
  destruct (Rle_dec (orient a b z) 0) as [L | L].
  - apply IH. destruct s; [exact Logic.I | apply T].
  - split; [lra | exact T].
Qed.

Lemma extend_in z s x : In x (extend z s) -> x = z \/ In x s.
Proof.
  induction s as [| b s IH]; [intros [-> | []]; now left |]. destruct s as [| a s].
  - intros [-> | H]; [now left | now right].
  - cbn [extend]. destruct (Rle_dec (orient a b z) 0) as [L | L].
    + intros H. destruct (IH H) as [E | E]; [now left | right; now right].
    + intros [-> | H]; [now left | now right].
Qed.

Lemma extend_pairs (R : point -> point -> Prop) z s : (forall x, In x s -> R x z) ->
  ForallOrdPairs (fun b a => R a b) s -> ForallOrdPairs (fun b a => R a b) (extend z s).
Proof.
  induction s as [| b s IH]; intros A D; [repeat constructor |]. destruct s as [| a s].
  - constructor; [| exact D]. apply Forall_forall. exact A.
  - cbn [extend]. destruct (Rle_dec (orient a b z) 0) as [L | L].
    + apply IH; [intros x I; apply A; now right | now inversion D].
    + constructor; [| exact D]. apply Forall_forall. exact A.
Qed.

(* The newest point is on top, the oldest stays at the bottom. *)
Lemma extend_top z s : exists r, extend z s = z :: r.
Proof.
  induction s as [| b s IH]; [now exists [] |]. destruct s as [| a s]; [now exists [b] |]. cbn [extend].
  destruct (Rle_dec (orient a b z) 0); [exact IH | now exists (b :: a :: s)].
Qed.

Lemma extend_bottom z s o : exists r, extend z (s ++ [o]) = r ++ [o] /\ exists r', r = z :: r'.
Proof.
  induction s as [| b s IH]; [exists [z]; split; [reflexivity | now exists []] |].
  destruct s as [| a s].
  - simpl. destruct (Rle_dec (orient o b z) 0); [exists [z] | exists [z; b]]; (split; [reflexivity | eexists; reflexivity]).
  - change ((b :: a :: s) ++ [o]) with (b :: a :: (s ++ [o])). cbn [extend].
    destruct (Rle_dec (orient a b z) 0).
    + exact IH.
    + exists (z :: b :: a :: s). split; [reflexivity | now exists (b :: a :: s)].
Qed.

Lemma chain_snoc l z : chain (l ++ [z]) = extend z (chain l).
Proof. unfold chain. now rewrite fold_left_app. Qed.

Lemma chain_turns l : turns (chain l).
Proof. induction l as [| z l IH] using rev_ind; [exact Logic.I |]. rewrite chain_snoc. now apply extend_turns. Qed.

Lemma chain_in l x : In x (chain l) -> In x l.
Proof.
  induction l as [| z l IH] using rev_ind; [easy |]. rewrite chain_snoc. intros H. apply in_or_app.
  destruct (extend_in z _ x H) as [-> | K]; [right; now left | left; now apply IH].
Qed.

Lemma pairs_app_inv {T : Type} (R : T -> T -> Prop) K L : ForallOrdPairs R (K ++ L) ->
  ForallOrdPairs R K /\ ForallOrdPairs R L /\ forall a b, In a K -> In b L -> R a b.
Proof.
  induction K as [| a K IH]; simpl; intros H; [split; [constructor | split; [exact H | now intros a b []]] |].
  inversion H as [| ? ? F H']; subst. apply Forall_app in F. destruct F as [F G]. destruct (IH H') as [A [B C]].
  split; [now constructor |]. split; [exact B |]. intros x b [<- | I] J; [| now apply C].
  rewrite Forall_forall in G. now apply G.
Qed.

Lemma chain_pairs (R : point -> point -> Prop) l : ForallOrdPairs R l -> ForallOrdPairs (fun b a => R a b) (chain l).
Proof.
  induction l as [| z l IH] using rev_ind; [constructor |]. intros H. rewrite chain_snoc.
  destruct (pairs_app_inv _ _ _ H) as [A [_ C]]. apply extend_pairs; [| now apply IH].
  intros x I. apply C; [now apply chain_in | now left].
Qed.

Lemma chain_ends l o e : exists r, chain (o :: l ++ [e]) = e :: r ++ [o].
Proof.
  assert (B : forall l, exists r, chain (o :: l) = r ++ [o]).
  { intros k. induction k as [| z k IH] using rev_ind; [now exists [] |]. destruct IH as [r E].
    change (o :: k ++ [z]) with ((o :: k) ++ [z]). rewrite chain_snoc, E.
    destruct (extend_bottom z r o) as [r' [E' _]]. now exists r'. }
  destruct (B l) as [r E]. change (o :: l ++ [e]) with ((o :: l) ++ [e]). rewrite chain_snoc, E.
  destruct (extend_bottom e r o) as [r' [E' [r'' ->]]]. now exists r''.
Qed.

(* ---- directions to one side ---- *)

Lemma lex_turns u v w : lex (0, 0) u -> lex (0, 0) v -> lex (0, 0) w ->
  0 < orient (0, 0) u v -> 0 < orient (0, 0) v w -> 0 < orient (0, 0) u w.
Proof.
  destruct u as [a b], v as [c d], w as [e f]. unfold lex, orient. simpl. intros U V W A B.
  assert (A' : 0 < a * d - b * c) by lra. assert (B' : 0 < c * f - d * e) by lra. clear A B.
  assert (E : c * (a * f - b * e) = a * (c * f - d * e) + e * (a * d - b * c)) by ring.
  assert (0 < c).
  { destruct V as [V | [V V']]; [exact V |]. exfalso. rewrite <- V in *. destruct W as [W | [W W']]; nra. }
  assert (0 < a \/ 0 < e \/ (a = 0 /\ e = 0)) as [P | [P | [-> ->]]] by (destruct U as [U | [U _]]; destruct W as [W | [W _]]; lra).
  - assert (0 < a * (c * f - d * e)) by (now apply Rmult_lt_0_compat).
    assert (0 <= e * (a * d - b * c)) by (apply Rmult_le_pos; destruct W as [W | [W _]]; lra). nra.
  - assert (0 < e * (a * d - b * c)) by (now apply Rmult_lt_0_compat).
    assert (0 <= a * (c * f - d * e)) by (apply Rmult_le_pos; destruct U as [U | [U _]]; lra). nra.
  - exfalso. destruct U as [U | [_ U]]; nra.
Qed.

Lemma lex_from o p : lex o p -> lex (0, 0) (fst p - fst o, snd p - snd o).
Proof. unfold lex. simpl. lra. Qed.

(* As seen from o. *)
Lemma turns_from o a b c : lex o a -> lex o b -> lex o c -> 0 < orient o a b -> 0 < orient o b c -> 0 < orient o a c.
Proof.
  intros A B C H G. pose proof (lex_turns _ _ _ (lex_from _ _ A) (lex_from _ _ B) (lex_from _ _ C)) as K.
  unfold orient in *. simpl in K. lra.
Qed.

Lemma turns_low o a b c : lex o a -> lex a b -> lex b c -> 0 < orient o a b -> 0 < orient a b c -> 0 < orient o b c.
Proof.
  intros A B C H G. pose proof (lex_turns _ _ _ (lex_from _ _ A) (lex_from _ _ B) (lex_from _ _ C)) as K.
  unfold orient in *. simpl in K. lra.
Qed.

Lemma turns_up o b a c : lex o b -> lex b a -> lex a c -> 0 < orient c a b -> 0 < orient a b o -> 0 < orient c a o.
Proof.
  intros A B C H G. assert (D : lex o a) by (unfold lex in *; lra).
  pose proof (lex_turns _ _ _ (lex_from _ _ C) (lex_from _ _ B) (lex_from _ _ D)) as K.
  unfold orient in *. simpl in K. lra.
Qed.

(* ---- chains as seen from their left end ---- *)

Fixpoint steps (R : point -> point -> Prop) (l : list point) : Prop :=
  match l with a :: ((b :: _) as r) => R a b /\ steps R r | _ => True end.

Lemma steps_join R l x k : steps R (l ++ [x]) -> steps R (x :: k) -> steps R (l ++ x :: k).
Proof.
  induction l as [| a l IH]; [easy |]. destruct l as [| b l].
  - intros [H _] K. now split.
  - intros [H T] K. split; [exact H | now apply IH].
Qed.

Lemma steps_rev (R : point -> point -> Prop) l : steps (fun b a => R a b) l -> steps R (rev l).
Proof.
  induction l as [| b l IH]; [easy |]. destruct l as [| a l]; [easy |]. intros [H T]. simpl. rewrite <- app_assoc. simpl.
  apply steps_join; [apply IH, T | simpl; tauto].
Qed.

Lemma steps_in_order o l : (forall x, In x l -> lex o x) -> steps (fun a b => 0 < orient o a b) l -> in_order o l.
Proof.
  intros H S. assert (K : ForallOrdPairs (fun a b => 0 < orient o a b) l).
  { induction l as [| a l IH]; [constructor |]. assert (S' : steps (fun a b => 0 < orient o a b) l) by (destruct l; [exact Logic.I | apply S]).
    assert (D : ForallOrdPairs (fun a b => 0 < orient o a b) l) by (apply IH; [intros x I; apply H; now right | exact S']).
    constructor; [| exact D]. destruct l as [| b l]; [constructor |]. destruct S as [A _].
    inversion D as [| ? ? F _]; subst. constructor; [exact A |]. rewrite Forall_forall in *. intros c I.
    apply (turns_from o a b c); [apply H; simpl; tauto | apply H; simpl; tauto | apply H; simpl; tauto | exact A | now apply F]. }
  clear S. induction K as [| a l F K IH]; constructor.
  - revert F. apply Forall_impl. intros. lra.
  - apply IH. intros x I. apply H. now right.
Qed.

Lemma low_steps o s : turns (s ++ [o]) -> ForallOrdPairs (fun b a => lex a b) (s ++ [o]) ->
  steps (fun b a => 0 < orient o a b) s.
Proof.
  induction s as [| c s IH]; [easy |]. destruct s as [| b s]; [easy |]. intros T D.
  inversion D as [| ? ? F D']; subst.
  assert (T' : turns ((b :: s) ++ [o])) by (destruct s; apply T).
  specialize (IH T' D'). split; [| exact IH]. destruct s as [| a s]; [apply T |].
  destruct IH as [H _]. destruct T as [G _]. inversion F as [| ? ? Fb _]; subst. inversion D' as [| ? ? Fa D'']; subst.
  inversion Fa as [| ? ? Fa' _]; subst. inversion D'' as [| ? ? Fo _]; subst.
  apply (turns_low o a b c); try assumption. rewrite Forall_forall in Fo. apply Fo. apply in_or_app. right. now left.
Qed.

Lemma up_steps o s : forall b a, turns (b :: a :: s) -> ForallOrdPairs lex (o :: b :: a :: s) -> 0 < orient a b o ->
  steps (fun b a => 0 < orient o a b) (b :: a :: s).
Proof.
  induction s as [| c s IH]; intros b a T D G.
  - split; [unfold orient in *; lra | exact Logic.I].
  - split; [unfold orient in *; lra |]. destruct T as [H T].
    inversion D as [| ? ? Fo D']; subst. inversion D' as [| ? ? Fb D'']; subst. inversion D'' as [| ? ? Fa _]; subst.
    inversion Fo as [| ? ? Lob Fo']; subst. inversion Fb as [| ? ? Lba _]; subst. inversion Fa as [| ? ? Lac _]; subst.
    apply IH; [exact T | now constructor | now apply (turns_up o b a c)].
Qed.

Theorem convex_polygon_counterclockwise l : ForallOrdPairs lex l -> counterclockwise (convex_polygon l).
Proof.
  intros H. destruct l as [| o l]; [exact Logic.I |].
  destruct l as [| e l _] using rev_ind; [cbn; constructor |].
  destruct (chain_ends l o e) as [r Er]. destruct (chain_ends (rev l) e o) as [u Eu].
  assert (Rv : rev (o :: l ++ [e]) = e :: rev l ++ [o]) by (simpl; now rewrite rev_app_distr).
  unfold convex_polygon. rewrite Rv, Er, Eu. simpl tl at 2.
  change (e :: r ++ [o]) with ((e :: r) ++ [o]). rewrite (rev_app_distr (e :: r)). rewrite rev_app_distr.
  simpl rev at 1. simpl app. simpl tl. change (in_order o (rev (e :: r) ++ rev u)). simpl rev at 1. rewrite <- app_assoc. simpl app.
  pose proof (chain_turns (o :: l ++ [e])) as T. rewrite Er in T.
  pose proof (chain_turns (e :: rev l ++ [o])) as T'. rewrite Eu in T'.
  pose proof (chain_pairs lex _ H) as D. rewrite Er in D.
  assert (D' : ForallOrdPairs lex (o :: u ++ [e])).
  { rewrite <- Eu. change (ForallOrdPairs (fun b a => (fun x y => lex y x) a b) (chain (e :: rev l ++ [o]))).
    apply chain_pairs. rewrite <- Rv. clear - H. induction H as [| a k F H IH]; [constructor |]. simpl.
    apply pairs_app; [exact IH | repeat constructor |]. intros x b I [<- | []]. rewrite Forall_forall in F.
    apply F, in_rev, I. }
  apply steps_in_order.
  - inversion D' as [| ? ? F _]; subst. rewrite Forall_forall in F. intros x I. apply in_app_or in I.
    destruct I as [I | I].
    + destruct (pairs_app_inv _ (e :: r) [o] D) as [_ [_ C]]. apply (C x o); [right; apply in_rev, I | now left].
    + apply F, in_or_app. destruct I as [<- | I]; [right; now left | left; apply in_rev, I].
  - apply steps_join.
    + change (rev r ++ [e]) with (rev (e :: r)). apply steps_rev. now apply low_steps.
    + change (e :: rev u) with ([e] ++ rev u). change [e] with (rev [e]). rewrite <- rev_app_distr. apply steps_rev.
      destruct u as [| b u]; [exact Logic.I |]. simpl app in *.
      assert (X : exists a k, u ++ [e] = a :: k) by (destruct u; simpl; eexists; eexists; reflexivity).
      destruct X as [a [k X]]. rewrite X in *. destruct T' as [G T']. now apply up_steps.
Qed.

Lemma convex_polygon_in l x : In x (convex_polygon l) -> In x l.
Proof.
  unfold convex_polygon. intros H. apply in_app_or in H. destruct H as [H | H].
  - apply in_rev in H. now apply chain_in.
  - assert (T : forall k (y : point), In y (tl k) -> In y k) by (intros [| a k] y I; [exact I | now right]).
    apply T in H. apply in_rev in H. apply T in H. apply chain_in in H. now apply in_rev.
Qed.
